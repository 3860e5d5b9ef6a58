#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// What a mesh file is found to hold before OpenMesh's reader gets it. The readers believe counts,
/// pass over what they cannot parse, and keep single precision: so numbers are checked here, and
/// positions read in double precision where the file has more.
struct MeshScan {
    std::vector<glm::dvec3> positions; ///< in the reader's order; empty if the reader's are as good
    std::size_t vertices = 0;          ///< that the reader must find; 0 if it may join some
    std::size_t faces = 0;             ///< that the reader must find

    std::string cleaned; ///< the text for the reader; empty: the file as it is
    bool isBinary = false;
};

// Each throws Error{input} for a file that is cut off, numbers that are none, or counts that the
// file is too small for; Error{unsupported} for a variant that is not read. `place` names the file.

MeshScan scanPly(std::string_view file, const std::string& place);
MeshScan scanOff(std::string_view file, const std::string& place);
MeshScan scanStl(std::string_view file, const std::string& place);

} // namespace sward::terrain
