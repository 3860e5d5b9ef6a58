#include "apps/sward/options/bake_options.h"

#include "apps/common/parse_text.h"
#include "bake/plan/paint_mask.h"
#include "bake/settings/baked_settings.h"
#include "bake/settings/stroke_file.h"
#include "core/error.h"
#include "core/log.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace sward::apps {
namespace {

constexpr int maxThreads = 1024;
constexpr double largestBladeScale = 1e5;
constexpr std::uint32_t maxHeightSamples = 32768; // on a side

// Parses an option's text, or its default; the bake's parsers report errors.
bake::SoftRange softRange(const char* option, const std::string& text, bake::SoftRange full)
{
    return text.empty() ? full : bake::parseSoftRange(option, text, full);
}

// Describes an invalid seed. CLI11's strtoull accepts -1 and numbers that are too large.
std::string seedTrouble(const std::string& text)
{
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    return error == std::errc() && stop == end
               ? ""
               : fmt::format("'{}' is not a whole number from 0 to {}", text, UINT64_MAX);
}

// Whether names leave ground bare. A painted mask says itself where grass grows.
bool readsBareNames(const std::string& text, const std::vector<bake::Mask>& masks)
{
    if (text != "auto" && text != "known" && text != "none")
        fail(ErrorKind::usage, "--bare-names is \"{}\"; expected auto, known or none", text);
    const bool isPainted = std::any_of(masks.begin(), masks.end(), [](const bake::Mask& mask) {
        return mask.source != bake::Mask::Source::groundGreen;
    });
    return text == "known" || (text == "auto" && !isPainted);
}

// "none" stands alone: no mask, and none of the ground's colours.
std::vector<bake::Mask> masksOf(const std::vector<std::string>& texts)
{
    std::vector<bake::Mask> masks;
    for (const std::string& text : texts) {
        if (text != "none")
            masks.push_back(bake::parseMask(text));
        else if (texts.size() > 1)
            fail(ErrorKind::usage, "--mask none: there are {} more masks; none stands alone",
                 texts.size() - 1);
    }
    return masks;
}

// Finds the species of strokes in a meadow.
bake::Strokes resolved(bake::Strokes strokes, const bake::Meadow& meadow)
{
    std::vector<std::string> names;
    for (const bake::SpeciesTraits& species : meadow.species)
        names.push_back(species.name);
    bake::resolveSpecies(strokes, names);
    return strokes;
}

// Joins "FILE:margin" and "M", which the shell separates, to one area.
std::vector<std::string> joinMargins(const std::vector<std::string>& words)
{
    std::vector<std::string> areas;
    for (const std::string& word : words)
        if (!areas.empty() && areas.back().ends_with(":margin"))
            areas.back() += " " + word;
        else
            areas.push_back(word);
    return areas;
}

} // namespace

void BakeOptions::add(CLI::App& app)
{
    app.add_option("INPUT", direct_.inputs,
                   "Ground, one or several files: a mesh (.glb .gltf .obj .ply .stl .off), a "
                   "heightmap (.png .r16 .raw .r32 .hgt .asc .exr), a map of heights (.tif .tiff), "
                   "a recipe (.json), or a built-in: plane sphere hills dunes torus arch")
        ->type_name("");
    addGround(app);
    addAmount(app);
    addPlaces(app);
    addBlades(app);
    addRun(app);
    log.add(app);
    log.addBar(app);
}

void BakeOptions::addGround(CLI::App& app)
{
    terrain::ImportSettings& import = direct_.import;
    const auto option = [&](const char* name, auto& value, const char* type, const char* text) {
        return app.add_option(name, value, text)->type_name(type)->group("Ground");
    };
    option("--up-axis", import.upAxis, "AXIS",
           "Axis of the file that points up: x, y, z, -x, -y or -z")
        ->capture_default_str();
    option("--units", import.units, "m|cm|mm|ft", "Length of one unit of the file")
        ->capture_default_str();
    option("--scale", import.scale, "F",
           "Factor on all lengths of the file, in addition to --units; above 0, up to 1e9")
        ->capture_default_str();
    option("--ground-up", groundUp_, "UP",
           "Direction against gravity, from which slope and altitude are measured: x, y, z, -x, "
           "-y, -z, or radial[:x,y,z], away from a point in metres")
        ->capture_default_str();
    option("--sides", sides_, "front|back|both", "Sides of the triangles that bear grass")
        ->capture_default_str();
    option("--scene", scene_, "N", "Scene of a glTF file, from 0")->default_str("the file's");
    option("--node", import.bearingNodes, "GLOB",
           "Only nodes of these names bear grass; * and ? are wildcards")
        ->default_str("all");
    option("--material", import.bearingMaterials, "GLOB",
           "Only materials of these names bear grass; * and ? are wildcards")
        ->default_str("all");
    option("--bare-names", bareNames_, "auto|known|none",
           "Whether parts of a mesh whose names say rock, water, road, roof and the like bear no "
           "grass; auto: known, but none where a painted --mask decides; --node and --material "
           "choose for themselves")
        ->capture_default_str();
    option("--occluder", direct_.occluders, "FILE",
           "Meshes that block rays and are drawn but bear no grass");
    option("--occlude-node", import.occluderNodes, "GLOB",
           "Nodes of INPUT that block rays and are drawn but bear no grass");

    // Settings missing in a heightmap file.
    terrain::HeightmapSettings& map = import.heightmap;
    const auto parsed = [&](const char* name, const char* type, const char* text, auto&& take) {
        return app.add_option_function<std::string>(name, take, text)
            ->type_name(type)
            ->group("Ground");
    };
    parsed("--size", "WxH",
           "Samples of a heightmap along x and z, at most 17 million in all; required for .r16, "
           ".raw and .r32; other formats state it",
           [&map](const std::string& text) {
               map.size = parseSize("--size", text, maxHeightSamples);
           });
    app.add_option_function<std::vector<double>>(
           "--extent",
           [&map](const std::vector<double>& sides) {
               map.extent = {sides.at(0), sides.at(1)};
           },
           "Size of a heightmap along x and z in metres")
        ->default_str("1 m from sample to sample")
        ->expected(2)
        ->type_name("X Z")
        ->group("Ground");
    parsed("--height", "MIN:MAX",
           "Heights of a heightmap's lowest and highest sample value in metres",
           [&map](const std::string& text) {
               const auto [low, high] = parseRange("--height", text);
               map.height = {low, high};
           })
        ->default_str("0 to a tenth of the longer side, of .exr as stored");
    option("--hole-mask", map.holeMask, "FILE",
           "Image over a heightmap; there is no ground where it is black or transparent");
    option("--endian", map.endian, "little|big", "Byte order of .r16, .raw and .r32")
        ->default_str("little");
    option("--encoding", map.encoding, "terrarium|terrain-rgb",
           "How the colours of a .png stand for heights in metres")
        ->default_str("none");
    app.add_flag("--flip-rows", map.flipRows, "The first row of a heightmap lies at +z, not at -z")
        ->group("Ground");
    parsed("--no-data", "V",
           "Sample value of a heightmap that stands for no height; it makes holes",
           [&map](const std::string& text) {
               map.noData = parseNumber("--no-data", text, -1e30, 1e30);
           });
}

void BakeOptions::addAmount(CLI::App& app)
{
    const char* group = "Amount";
    CLI::Option* density =
        app.add_option("--density", density_, "Blades per square metre, 0 to 1e15")
            ->default_str("what closes the meadow's sward, within --budget")
            ->type_name("N")
            ->group(group)
            ->each([this](const std::string&) { hasDensity_ = true; });
    CLI::Option* count = app.add_option("--count", count_, "Exact number of blades, 0 to 4 billion")
                             ->type_name("N")
                             ->group(group)
                             ->excludes(density)
                             ->each([this](const std::string&) { hasCount_ = true; });
    app.add_option("--spacing", spacing_,
                   "Least distance of roots in metres, 1e-9 to 1e9; implies --sampling poisson")
        ->type_name("M")
        ->group(group)
        ->excludes(density)
        ->excludes(count)
        ->each([this](const std::string&) { hasSpacing_ = true; });
    app.add_option("--sampling", sampling_,
                   "How roots are spread: uniform by area; poisson, none closer than a spacing; "
                   "poisson-dense, the same packed tighter, which takes longer")
        ->type_name("uniform|poisson|poisson-dense")
        ->each([this](const std::string&) { hasSampling_ = true; })
        ->group(group)
        ->capture_default_str();
    app.add_option(
           "--budget", direct_.settings.budget,
           "Largest number of blades, 1 to 4 billion, ribbons of plants included, of a bake "
           "without --density, --spacing and --count; fewer blades are wider, and the "
           "ground takes the sward's colour")
        ->type_name("N")
        ->group(group)
        ->capture_default_str();
    app.add_option("--max-blades", direct_.settings.maxBlades,
                   "Limit on the number of blades that are expected, 0 to 4 billion, ribbons of "
                   "plants included; a larger bake is refused before it begins")
        ->type_name("N")
        ->group(group)
        ->capture_default_str();
    app.add_option("--blade-scale", bladeScale_,
                   "Factor on the size of blades, 1e-6 to 1e5; auto: smaller and denser on small "
                   "ground")
        ->type_name("auto|F")
        ->group(group)
        ->capture_default_str();
}

void BakeOptions::addPlaces(CLI::App& app)
{
    bake::BakeSettings& settings = direct_.settings;
    const auto option = [&](const char* name, auto& value, const char* type, const char* text) {
        return app.add_option(name, value, text)->type_name(type)->group("Placement");
    };
    option("--slope", slope_, "MIN:MAX[~SOFT]", "Slope in degrees from --ground-up, 0 to 180")
        ->default_str("0:45~15 on a heightfield, else 0:180");
    option("--altitude", altitude_, "MIN:MAX[~SOFT]",
           "Altitude in metres along --ground-up; either end may be left out")
        ->default_str("unlimited");
    option("--curvature", curvature_, "MIN:MAX[~SOFT]",
           "Mean curvature in 1/m, above 0 on ridges, below 0 in hollows; either end may be left "
           "out")
        ->default_str("unlimited");
    option("--border", border_, "M[~SOFT]", "Least distance from the ground's borders in metres")
        ->default_str("any");
    option("--min-island", settings.minIsland, "AREA",
           "Connected pieces of ground below this area in square metres bear no grass")
        ->capture_default_str();
    option("--above-water", water_, "H[~SOFT]",
           "Altitude in metres along --ground-up below which nothing grows")
        ->default_str("no water");
    option("--clearance", settings.clearance, "M",
           "Free height above a root in metres, 0 to 1e9; 0: not tested")
        ->capture_default_str();
    option("--sky-rays", settings.exposureRays, "N",
           "Rays from each root to the sky, 0 to 1024; 0: every root sees all of it")
        ->capture_default_str();
    // Its former name; in no group, so that --help does not list it.
    option(formerSkyRays, settings.exposureRays, "N", "")
        ->group("")
        ->excludes("--sky-rays")
        ->each([](const std::string&) { log::warn("--exposure is now called --sky-rays"); });
    option("--ray-length", settings.rayLength, "M",
           "Length of the rays to the sky in metres, 0 to 1e9")
        ->capture_default_str();
    option("--sky", sky_, "MIN:MAX[~SOFT]",
           "Share of the rays to the sky that meet nothing, 0 to 1")
        ->default_str("0:1");
    option(
        "--mask", masks_, "MASK",
        "Factor on the density, from vertex-color:C (vertex-color1:C, vertex-color:_NAME), "
        "texture:FILE[:C] or material-texture:C, or ground:green, which is 1 where the ground's "
        "own colour is that of grass, or raster:FILE[:bN][:V,V|:A..B], which is 1 where band N of "
        "a GeoTIFF (.tif .tiff) has one of the values V, or rises from 0 at A to 1 at B; C is R, "
        "G, B or A; a texture lies at TEXCOORD_0, with :uv1 "
        "at another set, with :transform as the material's image; :or-white makes vertex colours "
        "white in parts without any; :invert may follow; may be repeated; none: no mask")
        ->allow_extra_args(false)
        ->default_str("ground:green where the ground is clearly green in part, else none");
    option("--exclude", excluded_, "FILE[:margin M]",
           "No grass above, below or within M metres of these meshes, or of the areas of a map "
           "(.geojson .gpkg .shp), whose lines and points need M; M is 0 to 1e9, 0 if left out");
    option("--paint", paint_, "FILE.json",
           "Strokes painted on the ground, in their order: more or less grass, species, heights, "
           "dry grass, trodden paths");
}

void BakeOptions::addBlades(CLI::App& app)
{
    app.add_option("--meadow", meadow_,
                   "Species that are sown: a .json file, or meadow, grass, hay, lawn, daisies, "
                   "alpine, marsh, prairie, steppe or dunes")
        ->type_name("FILE|NAME")
        ->group("Blades")
        ->capture_default_str();
    app.add_option("--set", assignments_,
                   "Changes a setting of the meadow, such as clump_size_m=1 or "
                   "species.NAME.share=0.2; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group("Blades");
    app.add_option("--align", align_,
                   "Direction of growth: along the surface's normal, along --ground-up, or between "
                   "them by F from 0 to 1")
        ->type_name("normal|vertical|blend:F")
        ->group("Blades")
        ->capture_default_str();
}

void BakeOptions::addRun(CLI::App& app)
{
    const char* group = "Run";
    app.add_option("-o,--output", direct_.output,
                   "Field file to write; required but for --dry-run and --print-config")
        ->type_name("OUT.sward")
        ->group(group);
    app.add_option(
           "--seed", direct_.settings.seed,
           "Start of the random numbers, 0 to 18446744073709551615; the same seed gives the "
           "same field")
        ->type_name("S")
        ->check(seedTrouble)
        ->group(group)
        ->capture_default_str();
    app.add_option("--threads", direct_.threads,
                   "Threads, 0 to 1024; 0: one for each CPU; the field does not depend on it")
        ->type_name("N")
        ->check(CLI::Range(0, maxThreads).description(""))
        ->group(group)
        ->capture_default_str();
    app.add_option("--report", direct_.report, "JSON file for counts, rejections by filter, times")
        ->type_name("FILE.json")
        ->group(group);
    app.add_option("--move-strokes", direct_.moveStrokes,
                   "Move points of strokes that are not on the ground onto it, by up to this "
                   "distance: after the ground was changed (requires --paint)")
        ->type_name("METRES")
        ->check(CLI::Range(bake::shortestRadius, bake::longestRadius).description(""))
        ->group(group);
    app.add_option("--paint-mask", direct_.paintMask,
                   "Image to write with the density that --paint and --mask ask for, over the "
                   "ground's TEXCOORD_0; it can be a --mask in their place (requires --paint)")
        ->type_name("OUT.png")
        ->group(group);
    app.add_option("--paint-mask-size", direct_.paintMaskSize,
                   "Texels on a side of that image, 1 to 8192")
        ->type_name("N")
        ->check(CLI::Range(1U, bake::maxPaintMaskSize).description(""))
        ->group(group)
        ->capture_default_str();
    app.add_option("--seeds", seeds_,
                   "Whether the field holds what bears, and only blades of the lowest ranks: the "
                   "others grow where the viewer or a host looks, and by 'sward grow'; auto: "
                   "where no density is given, and the closed sward exceeds --budget and 50 "
                   "million blades, if it can be sown")
        ->type_name("auto|always|never")
        ->group(group)
        ->capture_default_str();
    app.add_flag("--dry-run", direct_.dryRun, "Estimate counts and bytes, and write no field")
        ->group(group);
    app.add_flag("--force", direct_.overwrite, "Overwrite existing files")->group(group);
    app.add_flag("--print-config", printConfig, "Print the effective settings as JSON and exit")
        ->group(group);
}

std::vector<std::string> BakeRequest::sources() const
{
    std::vector<std::string> files = inputs;
    files.insert(files.end(), occluders.begin(), occluders.end());
    return files;
}

BakeRequest BakeOptions::request() const
{
    return requestWith(nullptr, {});
}

BakeRequest BakeOptions::requestAsBaked(const std::string& provenance,
                                        const std::string& place) const
{
    return requestWith(&provenance, place);
}

BakeRequest BakeOptions::requestWith(const std::string* provenance, const std::string& place) const
{
    BakeRequest request = direct_;
    bake::BakeSettings& settings = request.settings;

    if (hasDensity_)
        settings.density = density_;
    if (hasCount_)
        settings.count = count_;
    if (hasSpacing_)
        settings.spacing = spacing_;
    settings.spread = bake::parseSpread(hasSpacing_ && !hasSampling_ ? "poisson" : sampling_);
    if (bladeScale_ != "auto")
        settings.bladeScale = parseNumber("--blade-scale", bladeScale_, 0.0, largestBladeScale);
    request.import.scene = scene_;

    settings.sides = bake::parseSides(sides_);
    settings.align = bake::parseAlignment(align_);
    settings.seeds = bake::parseSeedUse(seeds_);
    settings.groundUp = bake::parseGroundUp(groundUp_);
    settings.slope = softRange("--slope", slope_, settings.slope);
    request.choosesSlope = slope_.empty() && settings.sides == bake::Sides::front;
    settings.altitude = softRange("--altitude", altitude_, settings.altitude);
    settings.curvature = softRange("--curvature", curvature_, settings.curvature);
    settings.sky = softRange("--sky", sky_, settings.sky);
    if (!border_.empty())
        settings.border = bake::parseSoftMinimum("--border", border_);
    if (!water_.empty())
        settings.water = bake::parseSoftMinimum("--above-water", water_);
    request.given = given;
    settings.masks = masksOf(masks_);
    settings.masks.insert(settings.masks.end(), given.masks.begin(), given.masks.end());
    for (const std::string& area : joinMargins(excluded_))
        settings.excluded.push_back(bake::parseExcludedArea(area));
    settings.meadow = bake::withAssignments(
        given.meadow ? *given.meadow : bake::loadMeadow(meadow_), assignments_);
    request.meadow = meadow_;
    settings.strokes.file = paint_;
    request.choosesMask = masks_.empty() && given.masks.empty();
    if (provenance != nullptr) {
        settings = bake::bakedSettings(*provenance, settings, place);
        request.choosesSlope = false;
        request.choosesMask = false;
    }
    request.import.bareNames = readsBareNames(bareNames_, settings.masks);
    const bool isPainted = given.strokes || !paint_.empty();
    if (isPainted)
        settings.strokes =
            resolved(given.strokes ? *given.strokes : bake::loadStrokes(paint_), settings.meadow);
    bake::validate(settings);
    request.import.masks = bake::maskInputs(settings);
    if (request.moveStrokes > 0.0 && !isPainted)
        fail(ErrorKind::usage, "--move-strokes: --paint is missing, whose strokes it moves");
    if (!request.paintMask.empty()) {
        if (!isPainted)
            fail(ErrorKind::usage,
                 "--paint-mask {}: --paint is missing, which says what is painted",
                 request.paintMask);
        bake::addPaintMaskInputs(request.import.masks);
    }
    if (!printConfig)
        bake::loadMaskImages(settings);

    // An output file is required to keep the result.
    if (given.ground)
        request.inputs = {given.groundName};
    if (!printConfig && request.inputs.empty())
        fail(ErrorKind::usage,
             "INPUT is missing: a mesh, a heightmap, a recipe, or a built-in such as hills.\n"
             "'sward bake --help' lists them.");
    if (needsOutput && !printConfig && !request.dryRun && request.output.empty())
        fail(ErrorKind::usage, "-o OUT.sward is missing; --dry-run alone writes no field");
    return request;
}

} // namespace sward::apps
