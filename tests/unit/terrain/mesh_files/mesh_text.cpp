#include "unit/terrain/mesh_files/mesh_text.h"

#include <fmt/core.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace sward::terrain {
namespace {

const int corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                           {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};

const int faces[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                          {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

template <typename Value>
void append(std::string& file, Value value, bool bigEndian = false)
{
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (bigEndian)
        std::reverse(bytes, bytes + sizeof value);
    file.append(bytes, sizeof value);
}

std::string plyHeader(const char* format, const char* type, int vertices, int faceCount)
{
    return fmt::format(
        "ply\nformat {} 1.0\ncomment a cube\nelement vertex {}\nproperty {} x\nproperty {} "
        "y\nproperty {} z\nelement face {}\nproperty list uchar int "
        "vertex_indices\nend_header\n",
        format, vertices, type, type, type, faceCount);
}

std::string cubePly(bool bigEndian)
{
    std::string file =
        plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian", "float", 8, 12);
    for (const auto& corner : corners)
        for (const int coordinate : corner)
            append(file, static_cast<float>(coordinate), bigEndian);
    for (const auto& face : faces) {
        file.push_back(3);
        for (const int index : face)
            append(file, static_cast<std::int32_t>(index), bigEndian);
    }
    return file;
}

// Binary OFF as Geomview writes it (big-endian, a colour count for each face) or as others do.
std::string cubeOff(bool bigEndian, bool faceColors)
{
    std::string file = "OFF BINARY\n";
    for (const std::int32_t count : {8, 12, 18})
        append(file, count, bigEndian);
    for (const auto& corner : corners)
        for (const int coordinate : corner)
            append(file, static_cast<float>(coordinate), bigEndian);
    for (const auto& face : faces) {
        append(file, std::int32_t(3), bigEndian);
        for (const int index : face)
            append(file, static_cast<std::int32_t>(index), bigEndian);
        if (faceColors)
            append(file, std::int32_t(0), bigEndian);
    }
    return file;
}

std::string cubeStl()
{
    std::string file(80, ' ');
    append(file, std::uint32_t(12));
    for (const auto& face : faces) {
        for (int i = 0; i < 3; ++i)
            append(file, 0.0f);
        for (const int index : face)
            for (const int coordinate : corners[index])
                append(file, static_cast<float>(coordinate));
        append(file, std::uint16_t(0));
    }
    return file;
}

} // namespace

std::vector<CubeFile> cubeFiles()
{
    std::string obj = "# a cube\n";
    std::string off = "OFF # a cube\n# with comments\n8 12 18\n";
    std::string ply = plyHeader("ascii", "float", 8, 12);
    std::string stl = "solid cube\n";
    for (const auto& c : corners) {
        const std::string line = fmt::format("{} {} {}\n", c[0], c[1], c[2]);
        obj += "v " + line;
        off += line;
        ply += line;
    }
    for (const auto& f : faces) {
        obj += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] - 8);
        off += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
        ply += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
        stl += "facet normal 0 0 0\nouter loop\n";
        for (const int index : f)
            stl += fmt::format("vertex {} {} {}\n", corners[index][0], corners[index][1],
                               corners[index][2]);
        stl += "endloop\nendfacet\n";
    }
    stl += "endsolid cube\n";
    return {{"cube.obj", obj},
            {"cube.off", off},
            {"cube.ply", ply},
            {"little.ply", cubePly(false)},
            {"big.ply", cubePly(true)},
            {"text.stl", stl},
            {"binary.stl", cubeStl()},
            {"geomview.off", cubeOff(true, true)},
            {"little.off", cubeOff(false, false)},
            {"colors.off", cubeOff(false, true)},
            {"plain.off", cubeOff(true, false)}};
}

std::string binaryPly(const std::vector<double>& coordinates)
{
    std::string file = plyHeader("binary_little_endian", "double", 3, 1);
    for (const double coordinate : coordinates)
        append(file, coordinate);
    file.push_back(3);
    for (const std::int32_t index : {0, 1, 2})
        append(file, index);
    return file;
}

} // namespace sward::terrain
