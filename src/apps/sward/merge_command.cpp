#include "apps/common/interrupt.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/files/working_folder.h"
#include "apps/sward/options/bake_arguments.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/seeds/seeded_field.h"
#include "bake/settings/threads.h"
#include "bake/tiles/stored_seeds.h"
#include "bake/tiles/tile_files.h"
#include "bake/whole/field_header.h"
#include "bake/whole/report_totals.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "core/system/peak_memory.h"
#include "field/read.h"
#include "field/write.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

// "0,3-5": the list format of a Slurm job array.
std::string arrayText(const std::vector<std::uint32_t>& indices)
{
    std::string text;
    for (std::size_t i = 0; i < indices.size();) {
        std::size_t last = i;
        while (last + 1 < indices.size() && indices[last + 1] == indices[last] + 1)
            ++last;
        text += fmt::format("{}{}", text.empty() ? "" : ",", indices[i]);
        if (last > i)
            text += fmt::format("-{}", indices[last]);
        i = last + 1;
    }
    return text;
}

// The field without blades that plan wrote.
field::Field fieldWithoutBlades(const fs::path& plan)
{
    const field::MappedField mapped = field::readField(bake::barePath(bake::partsFolder(plan)));
    const field::FieldView& view = mapped.view();
    field::Field field;
    field.origin = view.origin;
    field.thinned = view.thinned;
    field.species.assign(view.species.begin(), view.species.end());
    field.ground = *view.ground;
    field.defaults = *view.defaults;
    field.provenance = *view.provenance;
    field.copyright = *view.copyright;
    return field;
}

class MergeCommand : public Subcommand {
public:
    explicit MergeCommand(CLI::App& program)
        : Subcommand(program, "merge", "Join the tiles of a plan into one field file",
                     "sward merge county.json tiles -o county.sward")
    {
        app()
            .add_option("PLAN", plan_, "Plan file that 'sward plan' wrote")
            ->required()
            ->type_name("");
        app()
            .add_option("DIR", folder_, "Folder of the tiles that 'sward tile' wrote")
            ->required()
            ->type_name("");
        app()
            .add_option("-o,--output", output_, "Field file to write")
            ->type_name("OUT.sward")
            ->required();
        app()
            .add_option("--report", report_, "JSON file for counts, rejections by filter, times")
            ->type_name("FILE.json");
        app().add_flag("--force", force_, "Overwrite existing files");
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        checkOutputs();
        Stopwatch total;
        Stopwatch watch;
        const bake::TilePlan plan = bake::readPlan(plan_);
        const bake::BakeSettings settings = settingsOf(plan);
        bake::Totals totals;
        std::vector<std::uint32_t> missing;
        std::vector<std::uint32_t> damaged;
        bake::StoredCells cells;
        bake::StoredSeeds seeds;
        for (std::uint32_t i = 0; i < plan.tiles; ++i) {
            std::error_code ignored;
            if (!fs::exists(bake::tilePath(folder_, i), ignored))
                missing.push_back(i);
        }
        field::Field field = fieldWithoutBlades(plan_);
        // Verify every tile; keep patches only while no tile has failed.
        for (std::uint32_t i = 0; i < plan.tiles; ++i) {
            throwIfInterrupted("merge");
            if (std::binary_search(missing.begin(), missing.end(), i))
                continue;
            try {
                const fs::path path = bake::tilePath(folder_, i);
                bake::StoredTile stored =
                    bake::readTile(path, bake::tileId(plan, i), field.species.size());
                totals.add(stored.tile);
                if (missing.empty() && damaged.empty()) {
                    cells.add(std::move(stored.tile.cells), stored.stretch, path);
                    seeds.add(std::move(stored.tile.seeds.cells), stored.seedBytes, path);
                }
            } catch (const Error& error) {
                log::warn("{}", error.what());
                damaged.push_back(i);
                cells = bake::StoredCells();
            }
        }
        if (!missing.empty() || !damaged.empty()) {
            std::vector<std::uint32_t> again = missing;
            again.insert(again.end(), damaged.begin(), damaged.end());
            std::sort(again.begin(), again.end());
            fail(damaged.empty() ? ErrorKind::io : ErrorKind::input,
                 "{}: {} of {} tiles are missing ({}) and {} damaged ({}); bake again: {}", folder_,
                 missing.size(), plan.tiles, missing.empty() ? "none" : arrayText(missing),
                 damaged.size(), damaged.empty() ? "none" : arrayText(damaged), arrayText(again));
        }

        checkOutputs(); // against the tiles
        bake::Report report = plan.report;
        report.threads = bake::threadCount(0);
        report.timing.load = watch.lap();
        Diagnostics diagnostics;
        bake::finishReport(report, totals, settings, plan.plan, diagnostics);
        const std::vector<std::string> warnings = diagnostics.warnings();
        report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
        cells.layOut(field);
        if (plan.plan.seeds) {
            field.seeds =
                std::make_shared<const field::SharedSeeds>(seeds.layOut(*plan.plan.seeds));
            report.seeds = bake::seedsReport(field.seeds->seeds, cells.count());
        }
        report.timing.patches = watch.lap();
        report.output = {
            output_,
            field::writeField(field, cells, output_, force_, plan.plan.seeds ? &seeds : nullptr),
            field.patches.size()};
        report.timing.write = watch.lap();
        report.timing.total = total.lap();
        report.timing.totalBusy = processorSeconds();
        report.peakMemory = peakMemory();
        if (!report_.empty())
            writeTextFile(report_, bake::toJson(report), force_);
        tell(output_, report);
        return 0;
    }

private:
    void checkOutputs() const
    {
        checkOutput(output_, ".sward", {plan_}, force_);
        if (report_.empty())
            return;
        checkOutput(report_, ".json", {plan_}, force_);
        if (isSameFile(report_, output_))
            fail(ErrorKind::usage, "{}: is named both as the field and as the report", output_);
    }

    // Settings of the plan; file names are relative to its folder.
    bake::BakeSettings settingsOf(const bake::TilePlan& plan) const
    {
        const WorkingFolder working(plan.folder, plan_);
        return requestOf(plan.arguments, plan_).settings;
    }

    std::string plan_;
    std::string folder_;
    std::string output_;
    std::string report_;
    bool force_ = false;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addMerge(CLI::App& program)
{
    return std::make_unique<MergeCommand>(program);
}

} // namespace sward::apps
