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

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <filesystem>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t maxTiles = 1'000'000;

std::uint64_t digestOf(const std::string& text)
{
    std::uint64_t digest = text.size();
    for (const char c : text)
        digest = hashBits(digest, static_cast<unsigned char>(c));
    return digest;
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
        std::size_t triangles = 0;
        bake::withThreads(bake::threadCount(request.threads), [&] {
            triangles = write(ground, request, plan, output, diagnostics, progress);
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
            plan.plan.seeds ? ", with seeds of all" : "", triangles, ground.triangles.size()));
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
                             bake::TilePlan& plan, const fs::path& output, Diagnostics& diagnostics,
                             Progress& progress)
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
        const std::vector<std::vector<bake::CellNumber>> tiles =
            bake::dealTiles(ground, plan.tiles);
        const double margin = isSown ? bake::seedMargin(ground, settings, plan.plan)
                                     : bake::tileMargin(ground, settings, plan.plan);
        const std::vector<std::vector<std::uint32_t>> near =
            bake::trianglesNear(ground, tiles, margin);
        progress.begin("plan", tiles.size());
        std::size_t triangles = 0;
        for (std::uint32_t i = 0; i < tiles.size(); ++i) {
            bake::writePart(bake::partPath(parts.filling(), i), plan.id,
                            {bake::partOf(ground, near[i]),
                             bake::partOf(ground, features, near[i], margin), tiles[i]});
            triangles += near[i].size();
            progress.advance(1);
        }
        parts.put();
        bake::writePlan(output, plan, request.overwrite);
        parts.keep();
        return triangles;
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
