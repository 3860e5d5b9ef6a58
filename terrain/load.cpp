#include "terrain/load.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/files/mapped_file.h"
#include "core/json/settings_json.h"
#include "core/lower_case.h"
#include "terrain/files/file_kind.h"
#include "terrain/files/near_file.h"
#include "terrain/gltf/file/uri.h"
#include "terrain/gltf/import.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/loading/bare_names.h"
#include "terrain/loading/placement.h"
#include "terrain/loading/repeated_ground.h"
#include "terrain/loading/rounding.h"
#include "terrain/mesh_files/mesh_import.h"
#include "terrain/recipe.h"
#include "terrain/topology/soup.h"

#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace sward::terrain {
namespace {

constexpr std::uintmax_t sizeLimit = std::uintmax_t(4) << 30; // of any file [bytes]

// Generated ground or heights, moved as the settings say, unless they lie on a map.
GroundMesh movedBy(const ImportSettings& settings, GroundMesh mesh, const glm::dmat4& worldFromFile,
                   const std::string& name)
{
    if (mesh.hasPlace)
        requireUnmoved(settings, name);
    return placed(std::move(mesh), worldFromFile, name);
}

GroundMesh loadFile(const std::filesystem::path& path, const ImportSettings& settings,
                    const glm::dmat4& worldFromFile, Diagnostics& diagnostics)
{
    const std::string name = path.string();
    const std::string extension = fileKind(path);
    const std::uintmax_t size = std::filesystem::file_size(path);
    if (size > sizeLimit)
        fail(ErrorKind::unsupported, "{}: {} bytes, more than the {} that are read", name, size,
             sizeLimit);
    if (!isRawHeightmap(path) && !isMapRaster(path))
        refuseForeign(MappedFile(path).bytes(), name);
    if (extension == ".glb" || extension == ".gltf") {
        Soup soup = importGltf(path, settings, worldFromFile, diagnostics);
        warnOfRounding(soup, name, diagnostics);
        return settle(std::move(soup), name);
    }
    if (settings.scene)
        diagnostics.warn("{}: scene {} is ignored; only glTF has scenes", name, *settings.scene);
    if (extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".off") {
        Soup soup = importMesh(path, settings.masks, glm::length(glm::dvec3(worldFromFile[0])),
                               diagnostics);
        transform(soup, worldFromFile);
        warnOfRounding(soup, name, diagnostics);
        return settle(std::move(soup), name);
    }
    if (isHeightmap(path)) {
        GroundMesh mesh = importHeightmap(path, settings.heightmap, diagnostics);
        mesh.attributes.addGeneratedGaps(settings.masks, mesh.triangles.size(), name);
        return movedBy(settings, std::move(mesh), worldFromFile, name);
    }
    if (extension == ".json") {
        constexpr std::size_t recipeLimit = 1U << 20;
        const std::vector<std::byte> bytes = readFile(path, recipeLimit);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return movedBy(settings,
                       makeFromRecipe(text, name, path.parent_path(), diagnostics, settings.masks),
                       worldFromFile, name);
    }
    constexpr std::array<std::string_view, 9> models{".fbx",  ".blend", ".usd", ".usda", ".usdc",
                                                     ".usdz", ".dae",   ".3ds", ".max"};
    if (std::find(models.begin(), models.end(), extension) != models.end())
        fail(ErrorKind::unsupported,
             "{}: models of kind \"{}\" are not read; export it as glTF (.glb), for example with "
             "Blender",
             name, extension);
    fail(ErrorKind::unsupported,
         "{}: files of kind \"{}\" are not read; read are .glb .gltf .obj .ply .stl .off .png .r16 "
         ".raw .r32 .hgt .asc .exr .tif .json",
         name, extension);
}

bool isMeshFile(const std::string& extension)
{
    return extension == ".glb" || extension == ".gltf" || extension == ".obj" ||
           extension == ".ply" || extension == ".stl" || extension == ".off";
}

GroundMesh loadBuiltIn(const std::string& name, const ImportSettings& settings,
                       const glm::dmat4& worldFromFile, Diagnostics& diagnostics)
{
    const std::string_view recipe = builtInRecipe(name);
    if (recipe.empty()) {
        if (isOnNetwork(name))
            fail(ErrorKind::io, "{}: is on the network; nothing is fetched: save it first", name);
        if (std::error_code ignored; std::filesystem::exists(name, ignored))
            fail(ErrorKind::io, "{}: not a regular file, and no built-in terrain", name);
        const std::vector<std::string> known = builtInNames();
        const std::string near = nearestWord(name, known);
        fail(ErrorKind::io, "{}: no such file, and no built-in terrain ({}){}", name,
             fmt::join(known, " "),
             near.empty() ? nearFileHint(name) : fmt::format("; did you mean {}?", near));
    }
    return placed(makeFromRecipe(recipe, name, {}, diagnostics, settings.masks), worldFromFile,
                  name);
}

} // namespace

std::string fileKind(const std::filesystem::path& path)
{
    return lowerCase(path.extension().string());
}

GroundMesh load(const std::string& input, const ImportSettings& settings, Diagnostics& diagnostics)
{
    const glm::dmat4 worldFromFile = terrain::worldFromFile(settings);
    try {
        // An existing file wins over a built-in of its name.
        std::error_code ignored;
        const bool isFile = std::filesystem::is_regular_file(input, ignored);
        GroundMesh mesh = isFile ? loadFile(input, settings, worldFromFile, diagnostics)
                                 : loadBuiltIn(input, settings, worldFromFile, diagnostics);
        if (isFile && isMeshFile(fileKind(input)))
            removeCoarseLevels(mesh, settings, input, diagnostics);
        assignRoles(mesh, settings, input, diagnostics);
        // The names of generated ground are the program's own.
        if (isFile && settings.bareNames && isMeshFile(fileKind(input)))
            leaveBareByName(mesh, settings, input, diagnostics);
        return mesh;
    } catch (const std::bad_alloc&) {
        fail(ErrorKind::runtime, "{}: not enough memory for it", input);
    }
}

} // namespace sward::terrain
