#include "bake/bake_file.h"

#include "bake/patches/patch_tree.h"
#include "bake/seeds/seed_bake.h"
#include "bake/seeds/seeded_field.h"
#include "bake/tiles/stored_cells.h"
#include "bake/whole/whole_bake.h"
#include "core/files/piece_file.h"
#include "core/stopwatch.h"
#include "field/write.h"

#include <future>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

// Puts the blades of tiles into a temporary file, each while the next one is baked.
class Spill {
public:
    explicit Spill(const std::filesystem::path& output)
        : file_(std::make_shared<ScratchFile>(output))
    {
    }

    void add(std::vector<CellTree>&& cells)
    {
        wait();
        auto held = std::make_shared<std::vector<CellTree>>(std::move(cells));
        writing_ = std::async(std::launch::async, [this, held] { write(std::move(*held)); });
    }

    StoredCells& finish()
    {
        wait();
        return stored_;
    }

private:
    void wait()
    {
        if (writing_.valid())
            writing_.get();
    }

    void write(std::vector<CellTree>&& cells)
    {
        TileStretch stretch;
        stretch.blades = file_->size();
        eachStoredBlade(cells, [&](std::span<const shared::PackedBlade> blades) {
            file_->append(std::as_bytes(blades));
            stretch.count += blades.size();
        });
        stretch.keys = file_->size();
        eachStoredKeyByte(cells, [&](std::span<const std::byte> bytes) { file_->append(bytes); });
        for (CellTree& cell : cells) {
            // Assigning {} would keep the memory.
            decltype(cell.blades)().swap(cell.blades);
            decltype(cell.keys)().swap(cell.keys);
        }
        stored_.add(std::move(cells), stretch, file_);
    }

    std::shared_ptr<ScratchFile> file_;
    StoredCells stored_;
    std::future<void> writing_; // ends before the rest goes
};

void writeInto(const field::Field& field, Report& report, const std::filesystem::path& path,
               bool overwrite, Progress& progress)
{
    progress.begin("write", 1);
    Stopwatch watch;
    report.output.path = path.string();
    report.output.bytes = field::writeField(field, path, overwrite);
    report.timing.write = watch.lap();
}

// Bakes `ground`, which is also `consumed` unless that is null.
Report bakeInto(const terrain::GroundMesh& ground, terrain::GroundMesh* consumed,
                const BakeSettings& settings, int threads, const std::filesystem::path& path,
                bool overwrite, Diagnostics& diagnostics, Progress& progress,
                const TileLimits& limits)
{
    if (writesSeeds(ground, settings)) {
        BakeResult result =
            bakeSeededField(ground, settings, threads, limits, diagnostics, progress);
        writeInto(result.field, result.report, path, overwrite, progress);
        return std::move(result.report);
    }
    std::optional<Spill> spill;
    std::vector<CellTree> cells;
    field::Field field;
    CellTakers takers;
    takers.consumed = consumed;
    takers.begin = [&](bool inTiles) {
        if (inTiles)
            spill.emplace(path);
    };
    takers.take = [&](TileResult&& tile) {
        if (spill)
            spill->add(std::move(tile.cells));
        else
            cells = std::move(tile.cells);
    };
    takers.finish = [&](field::Field&& bare) {
        field = std::move(bare);
        if (spill)
            spill->finish().layOut(field);
        else
            joinCells(std::move(cells), field);
    };
    Report report = bakeWhole(ground, settings, threads, limits, takers, diagnostics, progress);
    progress.begin("write", 1);
    Stopwatch watch;
    report.output.path = path.string();
    report.output.patches = field.patches.size();
    report.output.bytes = spill ? field::writeField(field, spill->finish(), path, overwrite)
                                : field::writeField(field, path, overwrite);
    report.timing.write = watch.lap();
    return report;
}

} // namespace

Report bakeIntoFile(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    const std::filesystem::path& path, bool overwrite, Diagnostics& diagnostics,
                    Progress& progress, const TileLimits& limits)
{
    return bakeInto(ground, nullptr, settings, threads, path, overwrite, diagnostics, progress,
                    limits);
}

Report bakeIntoFile(terrain::GroundMesh&& ground, const BakeSettings& settings, int threads,
                    const std::filesystem::path& path, bool overwrite, Diagnostics& diagnostics,
                    Progress& progress, const TileLimits& limits)
{
    return bakeInto(ground, &ground, settings, threads, path, overwrite, diagnostics, progress,
                    limits);
}

} // namespace sward::bake
