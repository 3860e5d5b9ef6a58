#include "apps/common/output.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "core/log.h"
#include "core/lower_case.h"
#include "core/plain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace sward::apps {
namespace {

// What Sward reads or writes; a file under such a name is taken for one.
constexpr std::array<std::string_view, 31> formats{
    ".sward", ".json", ".png", ".csv",  ".glb",     ".gltf", ".ply",  ".usda",
    ".usd",   ".usdc", ".obj", ".mtl",  ".bin",     ".stl",  ".off",  ".r16",
    ".raw",   ".r32",  ".hgt", ".asc",  ".exr",     ".jpg",  ".jpeg", ".tga",
    ".bmp",   ".fbx",  ".tif", ".tiff", ".geojson", ".gpkg", ".shp"};
constexpr std::array<std::string_view, 4> exported{".glb", ".ply", ".usda", ".csv"};

std::string extensionOf(const std::filesystem::path& path)
{
    return lowerCase(path.extension().string());
}

void requireExtension(const std::string& path, std::string_view extension)
{
    const std::string found = extensionOf(path);
    if (found == extension || found.empty())
        return;
    if (std::ranges::find(formats, found) == formats.end())
        fail(ErrorKind::usage, "{}: what is written ends in {}, not in {}", path, extension, found);
    if (extension == ".sward" && std::ranges::find(exported, found) != exported.end())
        fail(ErrorKind::usage,
             "{}: a field is written, whose name ends in .sward; 'sward export' makes a {} of it",
             path, found);
    fail(ErrorKind::usage, "{}: what is written ends in {}; {} is the name of another format", path,
         extension, found);
}

} // namespace

void writeResult(std::string_view text)
{
    // Clear the status line: both streams may be the same terminal.
    log::setStatusLine("");
    const std::string plain = plainText(text);
    const bool written = std::fwrite(plain.data(), 1, plain.size(), stdout) == plain.size() &&
                         std::fflush(stdout) == 0;
    if (!written)
        fail(ErrorKind::io, "standard output: cannot write: {}", std::strerror(errno));
}

std::string sizeText(std::uint64_t bytes)
{
    constexpr std::array<const char*, 4> units{"kB", "MB", "GB", "TB"};
    if (bytes < 1000)
        return fmt::format("{} bytes", bytes);
    double value = double(bytes) / 1000.0;
    std::size_t unit = 0;
    // 999.95 would be printed as 1000.0.
    while (value >= 999.95 && unit + 1 < units.size()) {
        value /= 1000.0;
        ++unit;
    }
    return fmt::format("{:.1f} {}", value, units[unit]);
}

void requireOutput(const std::string& path, std::string_view extension, bool overwrite)
{
    requireExtension(path, extension);
    if (hasBeenRead(path))
        fail(ErrorKind::usage, "{}: is read and would be overwritten", path);
    requireWritable(path, overwrite);
}

} // namespace sward::apps
