#include "bake/tiles/stored_seeds.h"

#include "core/error.h"
#include "core/files/piece_file.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

namespace sward::bake {
namespace {

constexpr std::uint64_t maxOfRun = 1U << 20; // [bytes]; one frame at least
constexpr std::size_t maxOpen = 256;         // of the 1024 files of a process

} // namespace

void StoredSeeds::add(std::vector<field::SeedEntry>&& cells, std::uint64_t at,
                      std::filesystem::path file)
{
    if (!cells.empty())
        tiles_.push_back({std::move(cells), at, std::move(file)});
}

field::Seeds StoredSeeds::layOut(const field::SeedMeadow& meadow)
{
    field::Seeds seeds;
    seeds.meadow = meadow;
    struct Source {
        field::SeedEntry entry;
        std::uint32_t tile;
    };
    std::vector<Source> order;
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        for (const field::SeedEntry& entry : tiles_[t].cells)
            order.push_back({entry, t});
        std::vector<field::SeedEntry>().swap(tiles_[t].cells);
    }
    std::sort(order.begin(), order.end(),
              [](const Source& a, const Source& b) { return a.entry.cell < b.entry.cell; });
    seeds.cells.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        field::SeedEntry entry = order[i].entry;
        const std::uint32_t tile = order[i].tile;
        if (i > 0 && order[i - 1].entry.cell == entry.cell)
            fail(ErrorKind::input, "{}: has seeds of the cell ({}, {}, {}), as {} has",
                 tiles_[tile].file.string(), entry.cell[0], entry.cell[1], entry.cell[2],
                 tiles_[order[i - 1].tile].file.string());
        const std::uint64_t at = tiles_[tile].at + entry.offset;
        if (!runs_.empty() && runs_.back().tile == tile &&
            runs_.back().at + runs_.back().bytes == at && runs_.back().bytes < maxOfRun)
            runs_.back().bytes += entry.bytes;
        else
            runs_.push_back({tile, at, entry.bytes});
        entry.offset = seeds.elsewhere;
        seeds.elsewhere += entry.bytes;
        seeds.cells.push_back(entry);
    }
    return seeds;
}

void StoredSeeds::eachSeedByte(const field::TakeBytes& take) const
{
    std::map<std::uint32_t, PieceFile> open;
    UninitializedVector<std::byte> bytes;
    for (const Run& run : runs_) {
        if (open.size() >= maxOpen && open.find(run.tile) == open.end())
            open.clear();
        bytes.resize(run.bytes);
        open.try_emplace(run.tile, tiles_[run.tile].file).first->second.read(run.at, bytes);
        take(bytes);
    }
}

field::Seeds StoredSeeds::join(const field::SeedMeadow& meadow)
{
    field::Seeds seeds = layOut(meadow);
    seeds.data.resize(seeds.elsewhere);
    seeds.elsewhere = 0;
    std::size_t at = 0;
    eachSeedByte([&](std::span<const std::byte> bytes) {
        std::copy(bytes.begin(), bytes.end(), seeds.data.begin() + std::ptrdiff_t(at));
        at += bytes.size();
    });
    return seeds;
}

} // namespace sward::bake
