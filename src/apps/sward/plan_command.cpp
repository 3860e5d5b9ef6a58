#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/files/parts_folder.h"
#include "apps/sward/options/bake_arguments.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/ground_input.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/filter/root_filter.h"
#include "bake/seeds/seed_bake.h"
#include "bake/settings/stroke_file.h"
#include "bake/settings/threads.h"
#include "bake/tiles/tile_files.h"
#include "bake/whole/field_header.h"
#include "bake/whole/report_totals.h"
#include "bake/whole/whole_plan.h"
#include "core/error.h"
#include "core/log.h"
#include "core/random.h"
#include "field/write.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/heightmap/map_parts.h"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t maxTiles = 1'000'000;

// Points of the ground that a field shows of a map too large for one ground.
constexpr std::size_t overviewPoints = 4'200'000;

std::uint64_t digestOf(const std::string& text)
{
    std::uint64_t digest = text.size();
    for (const char c : text)
        digest = hashBits(digest, static_cast<unsigned char>(c));
    return digest;
}

// What needs the whole ground of a map, as an option; empty: nothing does.
std::string optionOfWhole(const BakeRequest& request)
{
    const bake::BakeSettings& settings = request.settings;
    if (const std::string option = terrain::windowlessOption(request.import); !option.empty())
        return option;
    if (request.inputs.size() > 1)
        return "a second INPUT";
    if (!request.occluders.empty())
        return "--occluder";
    if (settings.count)
        return "--count";
    const terrain::FeatureChoice choice = bake::featuresFor(settings);
    if (choice.borders)
        return "--border";
    if (choice.islands)
        return "--min-island";
    return choice.curvature ? "--curvature, or a species that it decides" : "";
}

// Surveys the map that is the ground, whose tiles read it by windows; none if the ground is
// something else, or small and needed as a whole.
std::optional<terrain::MapSurvey> surveyGround(BakeRequest& request, std::uint32_t tiles,
                                               Diagnostics& diagnostics)
{
    const std::string& input = request.inputs.front();
    std::error_code ignored;
    if (request.given.ground || !terrain::isMapRaster(input) ||
        !fs::is_regular_file(input, ignored) || !terrain::readsMaps())
        return std::nullopt;
    Diagnostics opening;
    terrain::MapHeights heights(input, request.import, opening);
    const std::size_t samples = heights.grid().points();
    const bool isLarge = samples > terrain::heightPointLimit;
    if (const std::string option = optionOfWhole(request); !option.empty()) {
        if (isLarge)
            fail(ErrorKind::unsupported,
                 "{}: {} samples are read window by window, and {} needs the whole ground", input,
                 samples, option);
        return std::nullopt;
    }
    terrain::MapSurvey survey =
        terrain::surveyMap(heights, terrain::heightPointLimit, overviewPoints);
    if (!isLarge)
        return survey;
    for (const std::string& warning : opening.warnings())
        diagnostics.warn("{}", warning);
    if (survey.missing > 0)
        diagnostics.warn("{}: {} of {} samples have no height and become holes", input,
                         survey.missing, samples);
    diagnostics.warn("{}: the field shows one sample of {} along each side of the ground, up to "
                     "{:.3g} m below it, so that no root is hidden",
                     input, survey.stride, survey.lowered);
    if (double(samples) > 2.0 * terrain::samplesOfTile * tiles)
        diagnostics.warn("{}: a tile of {:.3g} million samples takes about {:.2g} GB of memory; "
                         "with --tiles {:.0f} it takes less than one",
                         input, double(samples) / tiles * 1e-6,
                         double(samples) / tiles / terrain::samplesOfTile,
                         std::ceil(double(samples) / terrain::samplesOfTile));
    request.given.isHeightmap = true;
    return survey;
}

class PlanCommand : public Subcommand {
public:
    explicit PlanCommand(CLI::App& program)
        : Subcommand(program, "plan", "Split a bake into tiles for any number of machines",
                     "sward plan county.glb --tiles 64 -o county.json --density 200")
    {
        options_.add(app());
        for (const char* name : {"--dry-run", "--report", "--print-config", "--paint-mask",
                                 "--paint-mask-size", "--move-strokes"})
            app().remove_option(app().get_option(name));
        app()
            .get_option("--output")
            ->description("Plan file to write; its parts lie in a folder beside it")
            ->type_name("PLAN.json")
            ->required();
        app()
            .add_option("--tiles", tiles_, "Number of tiles of about equal area, 1 to 1 million")
            ->type_name("N")
            ->check(CLI::Range(1U, maxTiles).description(""))
            ->required()
            ->group("Run");
    }

    int run() const override
    {
        options_.log.apply();
        BakeRequest request = options_.request();
        const fs::path output = fs::absolute(request.output);
        checkOutputs(request, output);
        Diagnostics diagnostics;
        std::optional<terrain::MapSurvey> survey = surveyGround(request, tiles_, diagnostics);
        if (survey && survey->stride > 1)
            request.given.ground = [&](const terrain::ImportSettings&, Diagnostics&) {
                return std::move(survey->overview);
            };
        terrain::GroundMesh ground = loadGround(request, diagnostics);
        checkOutputs(request, output); // against all files that the ground names

        ProgressBar bar(options_.log.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        bake::TilePlan plan;
        plan.tiles = tiles_;
        plan.arguments = bakeArguments(app());
        if (request.choosesSlope)
            plan.arguments.insert(plan.arguments.begin(), // before "--"
                                  "--slope=" + bake::textOf(request.settings.slope));
        for (const bake::Mask& mask : request.settings.masks)
            if (request.choosesMask)
                plan.arguments.insert(plan.arguments.begin(), "--mask=" + bake::textOf(mask));
        plan.folder = fs::current_path().string();
        plan.paint = bake::hashOf(request.settings.strokes);
        plan.files = bake::planFiles(request.settings, request.meadow);
        std::size_t triangles = 0;
        bake::withThreads(bake::threadCount(request.threads), [&] {
            triangles = write(ground, request, survey ? &*survey : nullptr, plan, output,
                              diagnostics, progress);
        });
        bar.clear();
        for (const std::string& warning : diagnostics.warnings())
            log::warn("{}", warning);
        if (const std::string line = colorLine(plan.report); !line.empty())
            log::info("{}", line);
        const double stored = plan.plan.seeds ? plan.plan.seeds->stored : 1.0;
        writeResult(fmt::format(
            "{}: {} tiles of about {:.3g} blades{}, {} of {} triangles in parts\n", output.string(),
            plan.tiles, stored * plan.plan.plan.expected / double(plan.tiles),
            plan.plan.seeds ? ", with seeds of all" : "", triangles, plan.report.input.triangles));
        return 0;
    }

private:
    static void checkOutputs(const BakeRequest& request, const fs::path& output)
    {
        checkOutput(output.string(), ".json", request.sources(), request.overwrite);
        PartsFolder::requirePlace(bake::partsFolder(output));
    }

    // Write parts and the empty field first, the plan last: an existing plan is complete.
    static std::size_t write(terrain::GroundMesh& ground, const BakeRequest& request,
                             const terrain::MapSurvey* survey, bake::TilePlan& plan,
                             const fs::path& output, Diagnostics& diagnostics, Progress& progress)
    {
        const bake::BakeSettings& settings = request.settings;
        const terrain::SurfaceFeatures features = bake::featuresOf(ground, settings);
        const bool isSown = bake::writesSeeds(ground, settings);
        plan.plan =
            bake::planWhole({ground, features}, isSown ? bake::fullSettings(settings) : settings,
                            diagnostics, progress);
        if (isSown)
            bake::planSeeds(ground, settings, plan.plan);
        bake::Report& report = plan.report;
        report = bake::reportOf(ground, settings, 0);
        if (survey != nullptr && survey->stride > 1)
            report.input = inputOf(*survey, report.input);
        report.maskChosen = request.choosesMask;
        report.input.path = fmt::format("{}", fmt::join(request.inputs, ", "));
        report.bladeScale = plan.plan.plan.scale;
        report.warnings = diagnostics.warnings();
        plan.id = fmt::format("{}-{:016x}-{}{}", report.input.hash,
                              digestOf(bake::toJson(settings)), plan.tiles, isSown ? "-seeds" : "");

        PartsFolder parts(bake::partsFolder(output));
        field::writeField(bake::fieldWithoutBlades(ground, settings, plan.plan, report),
                          bake::barePath(parts.filling()), true);
        // All parts share the images; their pixels are not used after this.
        bake::writeImages(parts.filling(), plan.id, ground);
        for (terrain::GroundImage& image : ground.images)
            image.rgba = {};
        const double margin = isSown ? bake::seedMargin(ground, settings, plan.plan)
                                     : bake::tileMargin(ground, settings, plan.plan);
        plan.hasWindows = survey != nullptr;
        progress.begin("plan", plan.tiles);
        const std::size_t triangles =
            survey != nullptr
                ? writeWindows(*survey, plan, margin, parts.filling(), progress)
                : writeParts(ground, features, plan, margin, parts.filling(), progress);
        parts.put();
        bake::writePlan(output, plan, request.overwrite);
        parts.keep();
        return triangles;
    }

    // The parts of a ground in memory; returns the number of their triangles.
    static std::size_t writeParts(const terrain::GroundMesh& ground,
                                  const terrain::SurfaceFeatures& features,
                                  const bake::TilePlan& plan, double margin, const fs::path& folder,
                                  Progress& progress)
    {
        const std::vector<std::vector<bake::CellNumber>> tiles =
            bake::dealTiles(ground, plan.tiles);
        const std::vector<std::vector<std::uint32_t>> near =
            bake::trianglesNear(ground, tiles, margin);
        std::size_t triangles = 0;
        for (std::uint32_t i = 0; i < tiles.size(); ++i) {
            bake::writePart(bake::partPath(folder, i), plan.id,
                            {bake::partOf(ground, near[i]),
                             bake::partOf(ground, features, near[i], margin), tiles[i]});
            triangles += near[i].size();
            progress.advance(1);
        }
        return triangles;
    }

    // The same of a map: what tiles read of it.
    static std::size_t writeWindows(const terrain::MapSurvey& survey, const bake::TilePlan& plan,
                                    double margin, const fs::path& folder, Progress& progress)
    {
        const std::vector<bake::TileWindow> tiles = bake::dealWindows(survey, plan.tiles, margin);
        std::size_t triangles = 0;
        for (std::uint32_t i = 0; i < tiles.size(); ++i) {
            bake::writeWindow(bake::partPath(folder, i), plan.id, tiles[i]);
            triangles += std::size_t(2) * tiles[i].window.cells.x * tiles[i].window.cells.y;
            progress.advance(1);
        }
        return triangles;
    }

    // What a survey knows better than its overview.
    static bake::Report::Input inputOf(const terrain::MapSurvey& survey, bake::Report::Input input)
    {
        input.triangles = survey.triangles;
        input.area = survey.area;
        input.low = survey.low;
        input.high = survey.high;
        input.hash = fmt::format("{:016x}", hashBits(survey.heightsHash, digestOf(input.hash)));
        return input;
    }

    BakeOptions options_;
    std::uint32_t tiles_ = 1;
};

} // namespace

std::unique_ptr<Subcommand> addPlan(CLI::App& program)
{
    return std::make_unique<PlanCommand>(program);
}

} // namespace sward::apps
