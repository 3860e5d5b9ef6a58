#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Result of scanning a mesh file before OpenMesh's reader. The readers trust counts, skip what
/// they cannot parse, and keep single precision. So the scan checks numbers and reads positions in
/// double precision where the file has more.
struct MeshScan {
    std::vector<glm::dvec3> positions; ///< in the reader's order; empty if the reader's suffice
    std::vector<glm::vec4> colors; ///< of the vertices, [0, 1] if the file has integers; or empty
    std::vector<glm::vec2> uvs;    ///< of the vertices, (0, 0) in the lower left; or empty
    std::vector<std::vector<glm::vec2>> faceUvs; ///< of the corners of each face; or empty
    std::size_t vertices = 0;                    ///< expected of the reader; 0 if it may merge some
    std::size_t faces = 0;                       ///< expected of the reader

    std::string cleaned; ///< the text for the reader; empty: the file as it is
    bool isBinary = false;
};

// Each function throws Error{input} for a truncated file, invalid numbers, or counts too large for
// the file; Error{unsupported} for an unsupported variant. `place` names the file.

MeshScan scanPly(std::string_view file, const std::string& place);
MeshScan scanOff(std::string_view file, const std::string& place);
MeshScan scanStl(std::string_view file, const std::string& place);

} // namespace sward::terrain
