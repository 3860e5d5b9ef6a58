// Loading ground gives a mesh accepted by validate(), or an Error.

#include "core/diagnostics.h"
#include "core/error.h"
#include "fuzz/memory_file.h"
#include "terrain/load.h"
#include "terrain/recipe.h"

#include <nlohmann/json.hpp>

#include <iterator>

namespace sward::fuzz {
namespace {

void loadGround(Bytes bytes, const std::string& extension,
                const terrain::ImportSettings& settings = {})
{
    try {
        Diagnostics diagnostics;
        const std::string path = memoryFile().hold(bytes, extension).string();
        terrain::validate(terrain::load(path, settings, diagnostics), path);
    } catch (const Error&) {
    }
}

// Limits the cells and segments of a recipe: large grounds are valid, but slow down the fuzzer.
bool isSmall(const nlohmann::json& recipe)
{
    constexpr double most = 64.0;
    for (const auto& [key, value] : recipe.items()) {
        if (key != "cells" && key.find("segments") == std::string::npos && key != "rings")
            continue;
        for (const auto& number : value.is_array() ? value : nlohmann::json::array({value}))
            if (number.is_number() && number.get<double>() > most)
                return false;
    }
    return true;
}

} // namespace

void gltfImport(Bytes bytes)
{
    // The first bytes identify a GLB.
    loadGround(bytes, ".glb");
}

void meshImport(Bytes bytes)
{
    static constexpr const char* extensions[] = {".obj", ".ply", ".stl", ".off"};
    if (!bytes.empty())
        loadGround(bytes.subspan(1), extensions[bytes[0] % std::size(extensions)]);
}

void heightmapImport(Bytes bytes)
{
    static constexpr const char* extensions[] = {".png", ".r16", ".exr"};
    static constexpr const char* others[] = {".asc", ".hgt", ".r32"};
    if (bytes.size() < 3)
        return;
    const bool isOther = (bytes[0] & 0x20U) != 0;
    const std::string extension = (isOther ? others : extensions)[bytes[0] % std::size(extensions)];
    terrain::ImportSettings settings;
    settings.heightmap.flipRows = isOther && (bytes[1] & 1U) != 0;
    if (isOther && (bytes[1] & 2U) != 0)
        settings.heightmap.noData = bytes[2];
    settings.heightmap.extent = {10.0, 10.0};
    if ((bytes[0] & 0x80U) != 0)
        settings.heightmap.height = {-1.0, 1.0};
    if (extension == ".r16" || extension == ".r32")
        settings.heightmap.size = glm::uvec2(bytes[1], bytes[2]);
    const Bytes file = bytes.subspan(3);
    // Use the map as its own mask, as a valid or an invalid image.
    if ((bytes[0] & 0x40U) != 0)
        settings.heightmap.holeMask =
            memoryFile().hold(file, (bytes[1] & 1U) != 0 ? ".jpg" : ".png").string();
    loadGround(file, extension, settings);
}

void recipe(Bytes bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json parsed = nlohmann::json::parse(text, nullptr, false);
    if (parsed.is_object() && !isSmall(parsed))
        return;
    try {
        Diagnostics diagnostics;
        terrain::validate(
            terrain::makeFromRecipe(text, "recipe", memoryFile().folder() / "none", diagnostics),
            "recipe");
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
