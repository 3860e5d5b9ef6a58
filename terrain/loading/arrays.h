#pragma once

#include "terrain/load.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <string>
#include <vector>

namespace sward::terrain {

/// A mesh that a caller has in memory instead of in a file, in the units and axes of
/// ImportSettings.
struct MeshArrays {
    std::vector<glm::dvec3> vertices;        ///< finite, in [units]
    std::vector<glm::uvec3> triangles;       ///< three vertices each, anti-clockwise from the front
    std::vector<glm::vec4> colors;           ///< [0, 1] as images store them; or none
    std::vector<glm::vec2> uvs;              ///< (0, 0) at the upper left corner; or none
    std::vector<VertexAttribute> attributes; ///< for masks; a value for each vertex
    bool isSingle = false;                   ///< the vertices come from single precision
};

/// Heights that a caller has in memory: as a heightmap of the same samples, but NaN alone is no
/// ground. Values that mean no data in files, such as -9999, are heights here.
struct HeightArray {
    glm::uvec2 size{0U}; ///< samples along x and z, 2 or more each
    std::vector<float>
        values; ///< [m] within ±1e6, row by row from −z, along x first; NaN: no ground
};

/// Ground of arrays: what load() makes of a file with the same content (.ply; .r32 with
/// --size). `name` stands for the file in messages. Throws Error{usage, input} as load() does, and
/// Error{input} for heights out of their range.
GroundMesh load(MeshArrays&& mesh, const std::string& name, const ImportSettings& settings,
                Diagnostics& diagnostics);
GroundMesh load(HeightArray&& heights, const std::string& name, const ImportSettings& settings,
                Diagnostics& diagnostics);

} // namespace sward::terrain
