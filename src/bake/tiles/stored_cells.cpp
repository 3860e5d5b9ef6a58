#include "bake/tiles/stored_cells.h"

#include "core/error.h"
#include "core/expect.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace sward::bake {
namespace {

// Calls visit(cell, first blade, number of blades) for each level of each cell, in storage order.
template <typename Visit>
void forEachLevel(std::span<const CellTree> cells, Visit visit)
{
    std::vector<std::vector<std::uint32_t>> levels;
    std::size_t depth = 0;
    for (const CellTree& cell : cells) {
        levels.push_back(levelsOf(cell));
        depth = std::max(depth, levels.back().size() - 1);
    }
    for (std::size_t level = 0; level < depth; ++level)
        for (std::size_t c = 0; c < cells.size(); ++c)
            if (level + 1 < levels[c].size())
                visit(c, levels[c][level], levels[c][level + 1] - levels[c][level]);
}

} // namespace

void eachStoredBlade(std::span<const CellTree> cells,
                     const std::function<void(std::span<const shared::PackedBlade>)>& take)
{
    forEachLevel(cells, [&](std::size_t c, std::uint32_t first, std::uint32_t count) {
        take(std::span(cells[c].blades).subspan(first, count));
    });
}

void eachStoredKeyByte(std::span<const CellTree> cells, const field::TakeBytes& take)
{
    for (std::size_t byte = 0; byte < sizeof(field::BladeKey); ++byte)
        forEachLevel(cells, [&](std::size_t c, std::uint32_t first, std::uint32_t count) {
            field::regroup(std::as_bytes(std::span(cells[c].keys).subspan(first, count)),
                           sizeof(field::BladeKey), byte, take);
        });
}

// Opens the files of tiles as they are needed, and keeps some of them open.
class StoredCells::Files {
public:
    explicit Files(const StoredCells& stored)
        : stored_(stored)
    {
    }

    const PieceFile& of(std::uint32_t tile)
    {
        const Tile& wanted = stored_.tiles_[tile];
        if (wanted.open != nullptr)
            return *wanted.open;
        Kept& kept = kept_[tile % kept_.size()];
        if (kept.file == nullptr || kept.tile != tile)
            kept = {tile, std::make_unique<PieceFile>(wanted.path)};
        return *kept.file;
    }

private:
    struct Kept {
        std::uint32_t tile = 0;
        std::unique_ptr<PieceFile> file;
    };

    const StoredCells& stored_;
    std::array<Kept, 128> kept_; // two threads stay below the 1024 files of a process
};

void StoredCells::add(std::vector<CellTree>&& cells, const TileStretch& stretch,
                      std::shared_ptr<const PieceFile> file)
{
    addTile(std::move(cells), {stretch, std::move(file), {}});
}

void StoredCells::add(std::vector<CellTree>&& cells, const TileStretch& stretch,
                      std::filesystem::path file)
{
    for (const CellTree& cell : cells) {
        const auto [same, isNew] =
            tileOf_.try_emplace(cell.cell, static_cast<std::uint32_t>(tiles_.size()));
        if (!isNew)
            fail(ErrorKind::input, "{}: has the 32 m cell ({}, {}, {}), as {} has", file.string(),
                 cell.cell[0], cell.cell[1], cell.cell[2],
                 same->second < tiles_.size() ? tiles_[same->second].path.string()
                                              : "the same file");
    }
    addTile(std::move(cells), {stretch, nullptr, std::move(file)});
}

void StoredCells::addTile(std::vector<CellTree>&& cells, Tile tile)
{
    const std::size_t before = places_.size();
    places_.resize(before + cells.size(), {static_cast<std::uint32_t>(tiles_.size()), {}});
    std::uint32_t place = 0;
    forEachLevel(cells, [&](std::size_t c, std::uint32_t first, std::uint32_t count) {
        places_[before + c].levels.push_back({first, place});
        place += count;
    });
    expect(place == tile.stretch.count, "the patches of a tile own its blades");
    count_ += place;
    tiles_.push_back(std::move(tile));
    std::move(cells.begin(), cells.end(), std::back_inserter(cells_));
}

void StoredCells::layOut(field::Field& field)
{
    runs_ = layOutCells(cells_, field);
    cells_ = {};
    tileOf_ = {};
}

std::uint64_t StoredCells::placeOf(const BladeRun& run) const
{
    const std::vector<Level>& levels = places_[run.cell].levels;
    const auto after = std::upper_bound(
        levels.begin(), levels.end(), run.first,
        [](std::uint32_t first, const Level& level) { return first < level.first; });
    const Level& level = *std::prev(after);
    return level.place + (run.first - level.first);
}

void StoredCells::eachBlade(const TakeBlades& take) const
{
    Files files(*this);
    UninitializedVector<shared::PackedBlade> blades(maxRun);
    for (const BladeRun& run : runs_) {
        const std::uint32_t tile = places_[run.cell].tile;
        const std::span<shared::PackedBlade> read = std::span(blades).first(run.count);
        files.of(tile).read(tiles_[tile].stretch.blades + placeOf(run) * sizeof blades[0],
                            std::as_writable_bytes(read));
        take(read);
    }
}

void StoredCells::eachKeyByte(std::size_t byte, const field::TakeBytes& take) const
{
    Files files(*this);
    std::vector<std::byte> bytes(maxRun);
    for (const BladeRun& run : runs_) {
        const std::uint32_t tile = places_[run.cell].tile;
        const std::span<std::byte> read = std::span(bytes).first(run.count);
        const TileStretch& stretch = tiles_[tile].stretch;
        files.of(tile).read(stretch.keys + byte * stretch.count + placeOf(run), read);
        take(read);
    }
}

} // namespace sward::bake
