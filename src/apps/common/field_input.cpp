#include "apps/common/field_input.h"

#include "core/error.h"
#include "core/lower_case.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace sward::apps {

namespace fs = std::filesystem;

const std::vector<std::string>& groundExtensions()
{
    static const std::vector<std::string> extensions{
        ".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".png",  ".r16",
        ".raw", ".r32",  ".hgt", ".asc", ".exr", ".tif", ".tiff", ".json"};
    return extensions;
}

bool namesGround(const std::string& input)
{
    constexpr std::array<std::string_view, 6> builtIns{"plane", "sphere", "hills",
                                                       "dunes", "torus",  "arch"};
    const std::string extension = lowerCase(fs::path(input).extension().string());
    const std::vector<std::string>& extensions = groundExtensions();
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
        return true;
    return !fs::exists(input) &&
           std::find(builtIns.begin(), builtIns.end(), input) != builtIns.end();
}

void requireField(const std::string& input)
{
    if (namesGround(input))
        fail(ErrorKind::input,
             "{}: is ground, not a field; 'sward bake {} -o {}.sward' grows grass on it", input,
             input, fs::path(input).stem().string());
}

} // namespace sward::apps
