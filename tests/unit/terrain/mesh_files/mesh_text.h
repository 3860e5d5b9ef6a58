#pragma once

#include <string>
#include <vector>

namespace sward::terrain {

struct CubeFile {
    std::string name;
    std::string content;
};

/// The cube of side 2 around the origin, fronts outward, in OBJ, PLY (text, little and big endian),
/// OFF and STL (each as text and binary).
std::vector<CubeFile> cubeFiles();

/// A binary PLY of one triangle with double-precision coordinates.
std::string binaryPly(const std::vector<double>& coordinates);

} // namespace sward::terrain
