#include "apps/common/interrupt.h"
#include "apps/common/log_switches.h"
#include "apps/common/output.h"
#include "apps/sward/subcommand.h"
#include "bake/patch_tree.h"
#include "bake/tile_files.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "field/read.h"
#include "field/write.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

// "0,3-5": as a Slurm job array takes it.
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

// The field that plan wrote without blades.
field::Field bareField(const fs::path& plan)
{
    const field::MappedField mapped = field::readField(bake::barePath(plan));
    const field::FieldView& view = mapped.view();
    field::Field field;
    field.origin = view.origin;
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
        : Subcommand(program, "merge", "Join the tiles of a plan into a field file",
                     "sward merge county.json tiles -o county.sward")
    {
        app().add_option("PLAN", plan_, "What sward plan wrote")->required()->type_name("");
        app().add_option("DIR", folder_, "Folder of the tiles' results")->required()->type_name("");
        app()
            .add_option("-o,--output", output_, "Field file to write")
            ->type_name("OUT.sward")
            ->required();
        app().add_flag("--force", force_, "Overwrite existing files");
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        refuseOverwrite(output_, force_);
        const bake::TilePlan plan = bake::readPlan(plan_);
        std::vector<std::uint32_t> missing;
        std::vector<std::uint32_t> damaged;
        std::vector<bake::CellTree> cells;
        for (std::uint32_t i = 0; i < plan.tiles; ++i) {
            std::error_code ignored;
            if (!fs::exists(bake::tilePath(folder_, i), ignored))
                missing.push_back(i);
        }
        // Every tile is verified; blades are kept only while a field can come of them.
        for (std::uint32_t i = 0; i < plan.tiles; ++i) {
            throwIfInterrupted("merge");
            if (std::binary_search(missing.begin(), missing.end(), i))
                continue;
            try {
                bake::TileResult tile = bake::readTile(bake::tilePath(folder_, i), plan.id);
                if (missing.empty() && damaged.empty())
                    std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
            } catch (const Error& error) {
                log::warn("{}", error.what());
                damaged.push_back(i);
                cells = {};
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

        field::Field field = bareField(plan_);
        bake::joinCells(std::move(cells), field);
        const std::uint64_t bytes = field::writeField(field, output_, force_);
        writeResult(fmt::format("{}: {} blades in {} patches from {} tiles, {:.1f} MB\n", output_,
                                field.blades.size(), field.patches.size(), plan.tiles,
                                double(bytes) * 1e-6));
        return 0;
    }

private:
    std::string plan_;
    std::string folder_;
    std::string output_;
    bool force_ = false;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addMerge(CLI::App& program)
{
    return std::make_unique<MergeCommand>(program);
}

} // namespace sward::apps
