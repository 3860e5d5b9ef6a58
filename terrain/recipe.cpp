#include "terrain/recipe.h"

#include "core/embedded.h"
#include "core/error.h"
#include "core/json/settings_json.h"
#include "terrain/files/file_kind.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/load.h"
#include "terrain/procedural/landforms.h"
#include "terrain/procedural/primitives.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::embedded {
std::span<const EmbeddedFile> terrains();
} // namespace sward::embedded

namespace sward::terrain {
namespace {

constexpr double longest = 1e6;   // [m]
constexpr double smallest = 1e-3; // [m]
constexpr int maxCells = 8192;    // along one side

// Cells of a sphere or torus that fit into the 4 GB input limit. A grid needs less memory per cell
// (heightPointLimit).
constexpr std::uint64_t surfaceCellLimit = std::uint64_t(1) << 23;

// Reads the common types of a recipe through a SettingsReader.
class Recipe {
public:
    Recipe(const nlohmann::json& object, const std::string& place)
        : reader(object, place)
    {
    }

    void length(const char* key, double& value) { reader.read(key, value, smallest, longest); }

    void count(const char* key, std::uint32_t& value, int low)
    {
        int number = static_cast<int>(value);
        reader.read(key, number, low, maxCells);
        value = static_cast<std::uint32_t>(number);
    }

    void seed(std::uint64_t& value)
    {
        int number = static_cast<int>(value);
        reader.read("seed", number, 0, 0x7fffffff);
        value = static_cast<std::uint64_t>(number);
    }

    // A pair of lengths and of cell numbers, along x and z.
    void grid(const char* sizeKey, glm::dvec2& size, glm::uvec2& cells)
    {
        glm::vec2 extent(size);
        reader.read(sizeKey, extent, smallest, longest);
        size = glm::dvec2(extent);
        glm::dvec2 numbers(cells);
        reader.read("cells", numbers, 1, maxCells);
        requireWhole("cells", numbers);
        cells = glm::uvec2(numbers);
        requireCells("cells", cells.x, cells.y, heightPointLimit);
    }

    void requireCells(const char* key, std::uint64_t across, std::uint64_t along,
                      std::uint64_t limit) const
    {
        if ((across + 1) * (along + 1) > limit)
            fail(ErrorKind::input, "{}: {} x {} cells are more than {}", reader.placeOf(key),
                 across, along, limit);
    }

    void requireWhole(const char* key, const glm::dvec2& numbers) const
    {
        for (const double number : {numbers.x, numbers.y})
            if (number != std::floor(number))
                fail(ErrorKind::input, "{}: {} is not a whole number", reader.placeOf(key), number);
    }

    // An optional pair of numbers.
    void pair(const char* key, std::optional<glm::dvec2>& value, double low, double high)
    {
        glm::dvec2 numbers(0.0);
        reader.read(key, numbers, low, high);
        if (reader.has(key))
            value = numbers;
    }

    void octaves(Octaves& value)
    {
        reader.read("octaves", value.count, 1, 12);
        reader.read("lacunarity", value.lacunarity, 1.0, 8.0);
        reader.read("gain", value.gain, 0.0, 1.0);
    }

    SettingsReader reader;
};

GroundMesh plane(Recipe& recipe)
{
    PlaneSettings s;
    recipe.grid("size", s.size, s.cells);
    recipe.reader.finish();
    return makePlane(s);
}

GroundMesh sphere(Recipe& recipe)
{
    SphereSettings s;
    recipe.length("radius", s.radius);
    recipe.count("segments", s.segments, 3);
    recipe.count("rings", s.rings, 2);
    recipe.requireCells("rings", s.segments, s.rings, surfaceCellLimit);
    recipe.reader.finish();
    if (s.rings % 2 != 0)
        fail(ErrorKind::input, "{}: {} is odd; a sphere needs a ring on its equator",
             recipe.reader.placeOf("rings"), s.rings);
    return makeSphere(s);
}

GroundMesh torus(Recipe& recipe)
{
    TorusSettings s;
    recipe.length("major_radius", s.majorRadius);
    recipe.length("minor_radius", s.minorRadius);
    recipe.count("major_segments", s.majorSegments, 3);
    recipe.count("minor_segments", s.minorSegments, 3);
    recipe.requireCells("minor_segments", s.majorSegments, s.minorSegments, surfaceCellLimit);
    recipe.reader.finish();
    if (s.minorRadius >= s.majorRadius)
        fail(ErrorKind::input, "{}: {} is not below the major radius {}",
             recipe.reader.placeOf("minor_radius"), s.minorRadius, s.majorRadius);
    return makeTorus(s);
}

GroundMesh hills(Recipe& recipe)
{
    HillsSettings s;
    recipe.grid("extent", s.grid.extent, s.grid.cells);
    recipe.seed(s.seed);
    recipe.reader.read("height", s.height, 0.0, longest);
    recipe.length("width", s.width);
    recipe.octaves(s.octaves);
    recipe.reader.finish();
    return makeHills(s);
}

GroundMesh dunes(Recipe& recipe)
{
    DunesSettings s;
    recipe.grid("extent", s.grid.extent, s.grid.cells);
    recipe.seed(s.seed);
    recipe.reader.read("height", s.height, 0.0, longest);
    recipe.length("spacing", s.spacing);
    recipe.reader.read("wander", s.wander, 0.0, longest);
    recipe.reader.finish();
    return makeDunes(s);
}

GroundMesh arch(Recipe& recipe)
{
    ArchSettings s;
    recipe.length("span", s.span);
    recipe.length("thickness", s.thickness);
    recipe.reader.read("roughness", s.roughness, 0.0, longest);
    recipe.length("patch", s.patch);
    recipe.seed(s.seed);
    recipe.reader.finish();
    if (s.thickness + s.roughness >= s.span)
        fail(ErrorKind::input, "{}: {} and roughness {} leave no passage in a span of {}",
             recipe.reader.placeOf("thickness"), s.thickness, s.roughness, s.span);
    return makeArch(s);
}

GroundMesh mesh(Recipe& recipe, const std::string& place, const std::filesystem::path& folder,
                const MaskInputs& read, Diagnostics& diagnostics)
{
    std::string file;
    ImportSettings s;
    s.masks = read;
    recipe.reader.read("file", file);
    recipe.reader.read("up_axis", s.upAxis);
    recipe.reader.read("units", s.units);
    recipe.reader.read("scale", s.scale, 1e-9, 1e9);
    recipe.reader.finish();
    if (file.empty())
        fail(ErrorKind::input, "{}: file: missing", place);
    // Refuse nested recipes, because a recipe could name itself.
    if (fileKind(file) == ".json")
        fail(ErrorKind::input, "{}: file: {} is a recipe; a mesh is needed", place, file);
    return load((folder / file).string(), s, diagnostics);
}

GroundMesh heightmap(Recipe& recipe, const std::string& place, const std::filesystem::path& folder,
                     Diagnostics& diagnostics)
{
    std::string file;
    std::string mask;
    std::optional<glm::dvec2> size;
    HeightmapSettings s;
    recipe.reader.read("file", file);
    recipe.pair("size", size, 2.0, heightmapSideLimit);
    recipe.requireWhole("size", size.value_or(glm::dvec2(0.0)));
    recipe.pair("extent", s.extent, smallest, longest);
    recipe.pair("height", s.height, -longest, longest);
    recipe.reader.read("hole_mask", mask);
    recipe.reader.read("endian", s.endian);
    recipe.reader.read("encoding", s.encoding);
    recipe.reader.read("flip_rows", s.flipRows);
    double noData = 0.0;
    recipe.reader.read("no_data", noData, -1e30, 1e30);
    if (recipe.reader.has("no_data"))
        s.noData = noData;
    recipe.reader.finish();
    if (!isHeightmap(file))
        fail(ErrorKind::input,
             "{}: file: \"{}\" is not a heightmap (.png .r16 .raw .r32 .hgt .asc .exr .tif .tiff)",
             place, file);
    if (size)
        s.size = glm::uvec2(*size);
    if (!mask.empty())
        s.holeMask = (folder / mask).string();
    try {
        return importHeightmap(folder / file, s, diagnostics);
    } catch (const Error& error) {
        // Report usage errors as errors of the recipe.
        if (error.kind() == ErrorKind::usage)
            fail(ErrorKind::input, "{}: {}", place, error.what());
        throw;
    }
}

GroundMesh makeOfKind(const std::string& kind, Recipe& recipe, const std::string& place,
                      const std::filesystem::path& folder, Diagnostics& diagnostics)
{
    if (kind == "plane")
        return plane(recipe);
    if (kind == "sphere")
        return sphere(recipe);
    if (kind == "torus")
        return torus(recipe);
    if (kind == "hills")
        return hills(recipe);
    if (kind == "dunes")
        return dunes(recipe);
    if (kind == "arch")
        return arch(recipe);
    if (kind == "heightmap")
        return heightmap(recipe, place, folder, diagnostics);
    fail(ErrorKind::input,
         "{}: kind \"{}\" is not known; known are plane sphere torus hills dunes arch mesh "
         "heightmap",
         place, kind);
}

} // namespace

GroundMesh makeFromRecipe(std::string_view text, const std::string& place,
                          const std::filesystem::path& folder, Diagnostics& diagnostics,
                          const MaskInputs& read)
{
    const nlohmann::json object = parseJson(text, place);
    Recipe recipe(object, place);
    std::string kind;
    recipe.reader.read("kind", kind);
    if (kind == "mesh")
        return mesh(recipe, place, folder, read, diagnostics);
    GroundMesh made = makeOfKind(kind, recipe, place, folder, diagnostics);
    made.attributes.addGeneratedGaps(read, made.triangles.size(), place);
    return made;
}

std::string_view builtInRecipe(std::string_view name)
{
    for (const EmbeddedFile& file : embedded::terrains())
        if (file.name.substr(0, file.name.rfind('.')) == name)
            return file.text();
    return {};
}

std::vector<std::string> builtInNames()
{
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embedded::terrains())
        names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace sward::terrain
