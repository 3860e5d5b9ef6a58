#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/working_folder.h"
#include "apps/sward/options/bake_arguments.h"
#include "apps/sward/options/excluded_input.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/seeds/seeded_field.h"
#include "bake/settings/stroke_file.h"
#include "bake/settings/threads.h"
#include "bake/tiles/tile_files.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "terrain/heightmap/map_parts.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

constexpr int maxThreads = 1024;

class TileCommand : public Subcommand {
public:
    explicit TileCommand(CLI::App& program)
        : Subcommand(program, "tile", "Bake one tile of a plan",
                     "sward tile county.json --index $SLURM_ARRAY_TASK_ID -o tiles")
    {
        app()
            .add_option("PLAN", plan_, "Plan file that 'sward plan' wrote")
            ->required()
            ->type_name("");
        app()
            .add_option("--index", index_, "Number of the tile, from 0")
            ->type_name("I")
            ->required();
        app()
            .add_option("-o,--output", folder_, "Folder for the tiles; made if it is missing")
            ->type_name("DIR")
            ->required();
        app()
            .add_option("--threads", threads_, "Threads, 0 to 1024; 0: one for each CPU")
            ->type_name("N")
            ->check(CLI::Range(0, maxThreads).description(""))
            ->capture_default_str();
        app().add_flag("--force", force_, "Bake the tile again if it is there");
        log_.add(app());
        log_.addBar(app());
    }

    int run() const override
    {
        log_.apply();
        const bake::TilePlan plan = bake::readPlan(plan_);
        if (index_ >= plan.tiles)
            fail(ErrorKind::usage, "--index {}: {} has tiles 0 to {}", index_, plan_,
                 plan.tiles - 1);
        const fs::path output = fs::absolute(bake::tilePath(folder_, index_));
        const fs::path parts = fs::absolute(bake::partsFolder(plan_));
        // Keep an existing valid file; replace a damaged one.
        if (!force_ && isDone(output, bake::tileId(plan, index_))) {
            writeResult(
                fmt::format("{}: is there already; --force bakes it again\n", output.string()));
            return 0;
        }
        // File names of the settings are relative to the folder of the plan command.
        const WorkingFolder working(plan.folder, plan_);
        std::error_code trouble;
        fs::create_directories(output.parent_path(), trouble);
        if (trouble)
            fail(ErrorKind::io, "{}: cannot be made: {}", folder_, trouble.message());
        requireWritable(output, true);
        BakeRequest request = requestOf(plan.arguments, plan_);
        if (bake::hashOf(request.settings.strokes) != plan.paint)
            fail(ErrorKind::input, "{}: its strokes are not those of {}, which was made before",
                 request.settings.strokes.file, plan_);
        Diagnostics diagnostics;
        loadExcluded(request, diagnostics);
        bake::requireUnchanged(plan.files, bake::planFiles(request.settings, request.meadow),
                               plan_);
        const bake::TilePart ground = partOf(plan, request, parts, diagnostics);
        ProgressBar bar(log_.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        bake::TileResult tile;
        if (!ground.cells.empty() && !ground.ground.triangles.empty())
            bake::withThreads(bake::threadCount(threads_), [&] {
                const bake::TileRegion region(ground.ground.origin, ground.cells);
                const bake::GroundView part{ground.ground, ground.features};
                tile =
                    plan.plan.seeds
                        ? bake::bakeSeededTile(part, request.settings, plan.plan, &region, progress)
                        : bake::bakeTile(part, request.settings, plan.plan, &region, progress);
            });
        bar.clear();
        bake::writeTile(output, bake::tileId(plan, index_), tile);
        const std::string seeds =
            plan.plan.seeds ? fmt::format(", seeds in {} cells ({})", tile.seeds.cells.size(),
                                          sizeText(tile.seeds.data.size()))
                            : std::string();
        writeResult(fmt::format("{}: {} blades in {} cells{}\n", output.string(), tile.counts.kept,
                                tile.cells.size(), seeds));
        return 0;
    }

private:
    bake::TilePart partOf(const bake::TilePlan& plan, const BakeRequest& request,
                          const fs::path& parts, Diagnostics& diagnostics) const
    {
        if (!plan.hasWindows)
            return bake::readPart(parts, index_, plan.id);
        terrain::MapHeights map(request.inputs.front(), request.import, diagnostics);
        return bake::readWindowPart(parts, index_, plan.id, map);
    }

    // Whether the tile file is valid. False for a damaged one; throws for the file of another plan.
    static bool isDone(const fs::path& output, const std::string& id)
    {
        std::error_code ignored;
        if (!fs::exists(output, ignored))
            return false;
        std::string found;
        try {
            found = bake::idOfTile(output);
        } catch (const Error&) {
            return false;
        }
        if (found != id)
            fail(ErrorKind::input, "{}: belongs to plan {}, not {}; --force replaces it",
                 output.string(), found, id);
        return true;
    }

    std::string plan_;
    std::string folder_;
    std::uint32_t index_ = 0;
    int threads_ = 0;
    bool force_ = false;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addTile(CLI::App& program)
{
    return std::make_unique<TileCommand>(program);
}

} // namespace sward::apps
