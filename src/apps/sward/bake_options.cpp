#include "apps/sward/bake_options.h"

#include "apps/common/parse_text.h"
#include "core/error.h"

#include <CLI/CLI.hpp>

namespace sward::apps {
namespace {

constexpr int mostThreads = 1024;
constexpr double largestBladeScale = 1e6;
constexpr std::uint32_t mostHeightSamples = 32768; // on a side

// The text of an option, or its default; the parsers of the bake say what is wrong with it.
bake::SoftRange softRange(const char* option, const std::string& text, bake::SoftRange full)
{
    return text.empty() ? full : bake::parseSoftRange(option, text, full);
}

// "FILE:margin" and "M" are one area, though they stand apart on the command line.
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
                   "Ground: .glb .gltf .obj .ply .stl .off, a heightmap .png .r16 .exr, a recipe "
                   ".json, or one of plane sphere hills dunes torus arch; several are joined")
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
    option("--up-axis", import.upAxis, "AXIS", "Axis of the file that points up: x y z -x -y -z")
        ->capture_default_str();
    option("--units", import.units, "UNIT", "What one unit of the file is: m cm mm ft")
        ->capture_default_str();
    option("--scale", import.scale, "F", "Multiplies after the units")->capture_default_str();
    option("--ground-up", groundUp_, "UP",
           "What slope is measured from and gravity pulls against: an axis like y or -z, or "
           "radial[:x,y,z]")
        ->capture_default_str();
    option("--sides", sides_, "SIDES", "Sides that bear grass: front, back or both")
        ->capture_default_str();
    option("--scene", scene_, "N", "glTF scene; else the file's default");
    option("--node", import.bearingNodes, "GLOB", "Only these nodes bear grass");
    option("--material", import.bearingMaterials, "GLOB", "Only these materials bear grass");
    option("--occluder", direct_.occluders, "FILE", "Blocks rays, is shown, bears nothing");
    option("--occlude-node", import.occluderNodes, "GLOB", "The same for nodes of the input");

    // What the file of a heightmap does not say.
    terrain::HeightmapSettings& map = import.heightmap;
    const auto parsed = [&](const char* name, const char* type, const char* text, auto&& take) {
        app.add_option_function<std::string>(name, take, text)->type_name(type)->group("Ground");
    };
    parsed("--size", "WxH", "Samples of a heightmap; .r16 needs it, images know it",
           [&map](const std::string& text) {
               map.size = parseSize("--size", text, mostHeightSamples);
           });
    app.add_option_function<std::vector<double>>(
           "--extent",
           [&map](const std::vector<double>& sides) { map.extent = {sides.at(0), sides.at(1)}; },
           "Metres that a heightmap covers along x and z (default 1 m from sample to sample)")
        ->expected(2)
        ->type_name("X Z")
        ->group("Ground");
    parsed("--height", "MIN:MAX",
           "Metres of a heightmap's lowest and highest sample value (default 0 to a tenth of the "
           "longer side; .exr: its samples are metres)",
           [&map](const std::string& text) {
               const auto [low, high] = parseRange("--height", text);
               map.height = {low, high};
           });
    option("--hole-mask", map.holeMask, "FILE", "Image over a heightmap; no ground where black");
}

void BakeOptions::addAmount(CLI::App& app)
{
    const char* group = "How much";
    CLI::Option* density =
        app.add_option("--density", density_, "Blades per square metre (default 300)")
            ->type_name("N")
            ->group(group)
            ->each([this](const std::string&) { hasDensity_ = true; });
    CLI::Option* count = app.add_option("--count", count_, "Blades kept, exactly")
                             ->type_name("N")
                             ->group(group)
                             ->excludes(density)
                             ->each([this](const std::string&) { hasCount_ = true; });
    app.add_option("--spacing", spacing_,
                   "Metres that roots keep from one another; implies --sampling poisson")
        ->type_name("M")
        ->group(group)
        ->excludes(density)
        ->excludes(count)
        ->each([this](const std::string&) { hasSpacing_ = true; });
    app.add_option("--sampling", sampling_,
                   "How roots are spread: uniform, poisson, or poisson-dense (slower, tighter)")
        ->type_name("KIND")
        ->each([this](const std::string&) { hasSampling_ = true; })
        ->group(group)
        ->capture_default_str();
    app.add_option("--max-blades", direct_.settings.maxBlades, "More are refused before sampling")
        ->type_name("N")
        ->group(group)
        ->capture_default_str();
    app.add_option("--blade-scale", bladeScale_,
                   "Size of the blades; auto: smaller and denser on small ground")
        ->type_name("auto|F")
        ->group(group)
        ->capture_default_str();
}

void BakeOptions::addPlaces(CLI::App& app)
{
    bake::BakeSettings& settings = direct_.settings;
    const auto option = [&](const char* name, auto& value, const char* type, const char* text) {
        return app.add_option(name, value, text)->type_name(type)->group("Where");
    };
    option("--slope", slope_, "MIN:MAX[~SOFT]", "Degrees from ground-up (default 0:180)");
    option("--altitude", altitude_, "MIN:MAX[~SOFT]",
           "Metres along ground-up; either end may be left out");
    option("--curvature", curvature_, "MIN:MAX[~SOFT]",
           "Mean curvature in 1/m: above 0 on ridges, below 0 in hollows");
    option("--border", border_, "M[~SOFT]", "Metres from the ground's borders that stay bare");
    option("--min-island", settings.leastIsland, "AREA",
           "Square metres; smaller connected pieces of the ground bear nothing")
        ->capture_default_str();
    option("--above-water", water_, "H[~SOFT]", "Metres along ground-up below which nothing grows");
    option("--clearance", settings.clearance, "M", "Free height that a root needs")
        ->capture_default_str();
    option("--exposure", settings.exposureRays, "N",
           "Rays to the sky from each root; 0: all roots see all of it")
        ->capture_default_str();
    option("--ray-length", settings.rayLength, "M", "How far those rays look")
        ->capture_default_str();
    option("--sky", sky_, "MIN:MAX[~SOFT]", "Share of the sky, 0 to 1, that a root must see");
    option("--mask", masks_, "MASK",
           "Multiplies density: vertex-color:C, texture:FILE:C or material-texture:C with C one of "
           "R G B A, and perhaps :invert; may be repeated")
        ->allow_extra_args(false);
    option("--exclude", excluded_, "FILE[:margin M]",
           "Nothing grows above, below or nearer than M metres to these meshes");
}

void BakeOptions::addBlades(CLI::App& app)
{
    app.add_option("--meadow", meadow_, "What is sown: a .json file or a built-in meadow")
        ->type_name("FILE|NAME")
        ->group("Blades")
        ->capture_default_str();
    app.add_option("--set", assignments_,
                   "Changes the meadow: clump_size_m=1 or species.NAME.share=0.2; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->group("Blades");
    app.add_option("--align", align_,
                   "Where blades grow to: normal, vertical, or blend:F between them")
        ->type_name("ALIGN")
        ->group("Blades")
        ->capture_default_str();
}

void BakeOptions::addRun(CLI::App& app)
{
    const char* group = "Run";
    app.add_option("-o,--output", direct_.output, "Field file to write")
        ->type_name("OUT.sward")
        ->group(group);
    app.add_option("--seed", direct_.settings.seed, "Another number, another meadow")
        ->type_name("S")
        ->group(group)
        ->capture_default_str();
    app.add_option("--threads", direct_.threads,
                   "0: as many as the machine has; the result is the same for any number")
        ->type_name("N")
        ->check(CLI::Range(0, mostThreads).description(""))
        ->group(group)
        ->capture_default_str();
    app.add_option("--report", direct_.report, "Write counts, reasons and times as JSON")
        ->type_name("FILE")
        ->group(group);
    app.add_flag("--dry-run", direct_.dryRun, "Estimate counts and bytes, write no field")
        ->group(group);
    app.add_flag("--force", direct_.overwrite, "Overwrite existing files")->group(group);
    app.add_flag("--print-config", printConfig, "Print the effective settings as JSON and exit")
        ->group(group);
}

BakeRequest BakeOptions::request() const
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
    settings.groundUp = bake::parseGroundUp(groundUp_);
    settings.slope = softRange("--slope", slope_, settings.slope);
    settings.altitude = softRange("--altitude", altitude_, settings.altitude);
    settings.curvature = softRange("--curvature", curvature_, settings.curvature);
    settings.sky = softRange("--sky", sky_, settings.sky);
    if (!border_.empty())
        settings.border = bake::parseSoftMinimum("--border", border_);
    if (!water_.empty())
        settings.water = bake::parseSoftMinimum("--above-water", water_);
    for (const std::string& mask : masks_)
        settings.masks.push_back(bake::parseMask(mask));
    for (const std::string& area : joinMargins(excluded_))
        settings.excluded.push_back(bake::parseExcludedArea(area));
    settings.meadow = bake::withAssignments(bake::loadMeadow(meadow_), assignments_);
    bake::validate(settings);
    if (!printConfig)
        bake::loadMaskImages(settings);

    // A file is needed for what is kept.
    if (!printConfig && request.inputs.empty())
        fail(ErrorKind::usage, "INPUT is missing: a mesh, a recipe or a built-in such as hills.\n"
                               "Run 'sward bake --help' to see what it takes.");
    if (!printConfig && !request.dryRun && request.output.empty())
        fail(ErrorKind::usage, "-o OUT.sward is missing (only --dry-run writes no field).");
    return request;
}

} // namespace sward::apps
