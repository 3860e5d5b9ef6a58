#include "bake/tiles/stored_seeds.h"

#include "core/error.h"
#include "core/files/piece_file.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace sward::bake {

void StoredSeeds::add(std::vector<field::SeedEntry>&& cells, std::uint64_t at,
                      std::filesystem::path file)
{
    if (!cells.empty())
        tiles_.push_back({std::move(cells), at, std::move(file)});
}

field::Seeds StoredSeeds::join(const field::SeedMeadow& meadow) const
{
    field::Seeds seeds;
    seeds.meadow = meadow;
    struct Source {
        field::SeedEntry entry;
        std::size_t tile;
    };
    std::vector<Source> order;
    std::uint64_t bytes = 0;
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        for (const field::SeedEntry& entry : tiles_[t].cells) {
            order.push_back({entry, t});
            bytes += entry.bytes;
        }
    std::sort(order.begin(), order.end(),
              [](const Source& a, const Source& b) { return a.entry.cell < b.entry.cell; });
    // Each file is read once, from its beginning to its end.
    seeds.data.resize(bytes);
    std::vector<std::vector<std::uint64_t>> places(tiles_.size());
    std::uint64_t at = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        field::SeedEntry entry = order[i].entry;
        if (i > 0 && order[i - 1].entry.cell == entry.cell)
            fail(ErrorKind::input, "{}: has seeds of the cell ({}, {}, {}), as {} has",
                 tiles_[order[i].tile].file.string(), entry.cell[0], entry.cell[1], entry.cell[2],
                 tiles_[order[i - 1].tile].file.string());
        entry.offset = at;
        at += entry.bytes;
        seeds.cells.push_back(entry);
        places[order[i].tile].push_back(entry.offset);
    }
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        const Tile& tile = tiles_[t];
        const PieceFile file(tile.file);
        for (std::size_t i = 0; i < tile.cells.size(); ++i)
            file.read(tile.at + tile.cells[i].offset,
                      std::span<std::byte>(seeds.data).subspan(places[t][i], tile.cells[i].bytes));
    }
    return seeds;
}

} // namespace sward::bake
