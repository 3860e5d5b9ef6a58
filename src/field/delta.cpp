#include "field/delta.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "field/seeds/seeds.h"
#include "field/verify.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace sward::field {
namespace {

constexpr std::array<char, 8> deltaMagic{'S', 'W', 'D', 'E', 'L', 'T', 'A', '1'};
constexpr std::array<char, 8> seededMagic{'S', 'W', 'D', 'E', 'L', 'T', 'A', '2'}; // with seeds

struct DeltaHeader {
    std::array<char, 8> magic = deltaMagic;
    std::uint64_t fileBytes = 0;
    std::uint64_t hash = 0; // XXH3-64 of all that follows
    std::array<double, 3> origin = {};
    std::uint64_t cells = 0;
};
static_assert(sizeof(DeltaHeader) == 56);
constexpr std::size_t unhashedBytes = offsetof(DeltaHeader, origin);

struct DeltaCell {
    std::array<std::int64_t, 3> cell = {};
    std::uint64_t patches = 0;
    std::uint64_t blades = 0;
};
static_assert(sizeof(DeltaCell) == 40);

// What bears in a cell: numbers of elements.
struct DeltaSeeds {
    std::array<std::int32_t, 3> cell = {};
    std::uint32_t vertices = 0;
    std::uint32_t pieces = 0;
    std::uint32_t clumps = 0;
    std::uint32_t conditions = 0;
    std::uint32_t words = 0;
};
static_assert(sizeof(DeltaSeeds) == 32);
constexpr std::array<std::uint32_t, 1> padding{0};

// All parts have lengths that are multiples of 8, so that no byte lies between them.
// Seeds of a cell, whose lengths are multiples of 4, are followed by 4 bytes if need be.
static_assert(sizeof(shared::Patch) % 8 == 0 && sizeof(shared::PackedBlade) % 8 == 0 &&
              sizeof(BladeKey) % 8 == 0);

// Takes the parts of a mapped delta one after the other.
class DeltaCursor {
public:
    DeltaCursor(std::span<const std::byte> bytes, std::string place)
        : bytes_(bytes)
        , place_(std::move(place))
    {
    }

    template <typename T>
    std::span<const T> take(std::uint64_t count, const char* what)
    {
        if (count > (bytes_.size() - at_) / sizeof(T))
            fail(ErrorKind::input, "{}: {} {} do not fit into the {} bytes that are left", place_,
                 count, what, bytes_.size() - at_);
        const std::span<const T> part(reinterpret_cast<const T*>(bytes_.data() + at_), count);
        at_ += part.size_bytes();
        return part;
    }

    std::uint64_t left() const { return bytes_.size() - at_; }

private:
    std::span<const std::byte> bytes_;
    std::string place_;
    std::size_t at_ = 0;
};

template <typename T>
std::span<const std::byte> bytesOf(std::span<const T> values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(values);
}

void requireCell(const CellChange& change, std::span<const Species> species,
                 const std::string& place)
{
    if (change.patches.empty() != change.blades.empty())
        fail(ErrorKind::input, "{}: {} patches with {} blades", place, change.patches.size(),
             change.blades.size());
    FieldView view;
    view.patches = change.patches;
    view.blades = change.blades;
    view.keys = change.keys;
    view.species = species;
    verifyBlades(view, place);
}

bool isOdd(const DeltaSeeds& seeds)
{
    const std::uint64_t words =
        std::uint64_t(seeds.clumps) * (sizeof(shared::SeedClump) / 4) + seeds.words;
    return words % 2 != 0;
}

// What bears in a cell, in the order of its counts.
std::shared_ptr<const SeedCell> takeSeeds(DeltaCursor& cursor, const DeltaSeeds& counts,
                                          const std::string& place)
{
    const auto cell = std::make_shared<SeedCell>();
    cell->cell = counts.cell;
    const auto take = [&](auto& to, std::uint32_t count, const char* what) {
        using Element = typename std::remove_reference_t<decltype(to)>::value_type;
        const auto from = cursor.take<Element>(count, what);
        to.assign(from.begin(), from.end());
    };
    take(cell->vertices, counts.vertices, "vertices of seeds");
    take(cell->pieces, counts.pieces, "pieces of seeds");
    take(cell->clumps, counts.clumps, "clumps of seeds");
    take(cell->conditions, counts.conditions, "conditions of seeds");
    take(cell->words, counts.words, "words of seeds");
    if (isOdd(counts))
        cursor.take<std::uint32_t>(1, "bytes behind seeds");
    verifySeedCell(*cell, place);
    return cell;
}

} // namespace

void writeDelta(const std::filesystem::path& path, const Delta& delta)
{
    DeltaHeader header;
    header.fileBytes = sizeof header;
    header.origin = {delta.origin.x, delta.origin.y, delta.origin.z};
    header.cells = delta.cells.size();
    std::vector<DeltaCell> table;
    std::vector<std::span<const std::byte>> parts;
    for (const CellChange& change : delta.cells)
        table.push_back({change.cell, change.patches.size(), change.blades.size()});
    parts.push_back(bytesOf(std::span<const DeltaCell>(table)));
    for (const CellChange& change : delta.cells) {
        parts.push_back(bytesOf(change.patches));
        parts.push_back(bytesOf(change.blades));
        parts.push_back(bytesOf(change.keys));
    }
    const std::array<std::uint64_t, 1> seededCells{delta.seeds.size()};
    std::vector<DeltaSeeds> seeds;
    for (const std::shared_ptr<const SeedCell>& one : delta.seeds) {
        const SeedEntry entry = entryOf(*one);
        seeds.push_back({entry.cell, entry.vertices, entry.pieces, entry.clumps, entry.conditions,
                         entry.words});
    }
    if (!seeds.empty()) {
        header.magic = seededMagic;
        parts.push_back(std::as_bytes(std::span(seededCells)));
        parts.push_back(bytesOf(std::span<const DeltaSeeds>(seeds)));
    }
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const SeedCell& cell = *delta.seeds[i];
        parts.push_back(std::as_bytes(std::span(cell.vertices)));
        parts.push_back(std::as_bytes(std::span(cell.pieces)));
        parts.push_back(std::as_bytes(std::span(cell.clumps)));
        parts.push_back(std::as_bytes(std::span(cell.conditions)));
        parts.push_back(std::as_bytes(std::span(cell.words)));
        if (isOdd(seeds[i]))
            parts.push_back(std::as_bytes(std::span(padding)));
    }

    const std::span<const std::byte> hashedHeader =
        std::as_bytes(std::span(&header, 1)).subspan(unhashedBytes);
    XXH3_state_t* const hash = XXH3_createState();
    XXH3_64bits_reset(hash);
    XXH3_64bits_update(hash, hashedHeader.data(), hashedHeader.size());
    for (const std::span<const std::byte> part : parts) {
        XXH3_64bits_update(hash, part.data(), part.size());
        header.fileBytes += part.size();
    }
    header.hash = XXH3_64bits_digest(hash);
    XXH3_freeState(hash);

    AtomicFile file(path, true);
    file.write(std::as_bytes(std::span(&header, 1)));
    for (const std::span<const std::byte> part : parts)
        file.write(part);
    file.commit(false);
}

Delta readDelta(const std::filesystem::path& path, std::span<const Species> species)
{
    const auto file = std::make_shared<const MappedFile>(path);
    const std::span<const std::byte> bytes = file->bytes();
    const std::string place = path.string();
    DeltaHeader header;
    if (bytes.size() < sizeof header)
        fail(ErrorKind::input, "{}: {} bytes, too short for the header of a delta ({})", place,
             bytes.size(), sizeof header);
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != deltaMagic && header.magic != seededMagic)
        fail(ErrorKind::input,
             "{}: not a delta (it begins with neither \"SWDELTA1\" nor \"SWDELTA2\")", place);
    if (header.fileBytes != bytes.size())
        fail(ErrorKind::input, "{}: {} bytes instead of {}", place, bytes.size(), header.fileBytes);
    if (XXH3_64bits(bytes.data() + unhashedBytes, bytes.size() - unhashedBytes) != header.hash)
        fail(ErrorKind::input, "{}: is damaged (hash differs)", place);

    Delta delta;
    delta.origin = {header.origin[0], header.origin[1], header.origin[2]};
    for (const double coordinate : header.origin)
        if (!std::isfinite(coordinate))
            fail(ErrorKind::input, "{}: the origin is not finite", place);
    DeltaCursor cursor(bytes.subspan(sizeof header), place);
    for (const DeltaCell& cell : cursor.take<DeltaCell>(header.cells, "cells")) {
        const std::string name =
            fmt::format("{}: cell ({}, {}, {})", place, cell.cell[0], cell.cell[1], cell.cell[2]);
        if (!delta.cells.empty() && delta.cells.back().cell >= cell.cell)
            fail(ErrorKind::input, "{}: does not follow the one before it", name);
        CellChange& change = delta.cells.emplace_back();
        change.cell = cell.cell;
        change.patches = cursor.take<shared::Patch>(cell.patches, "patches");
        change.blades = cursor.take<shared::PackedBlade>(cell.blades, "blades");
        change.keys = cursor.take<BladeKey>(cell.blades, "keys");
        requireCell(change, species, name);
    }
    if (header.magic == seededMagic) {
        const std::uint64_t count = cursor.take<std::uint64_t>(1, "number of seeds").front();
        for (const DeltaSeeds& counts : cursor.take<DeltaSeeds>(count, "cells of seeds")) {
            const std::string name = fmt::format("{}: seeds of cell ({}, {}, {})", place,
                                                 counts.cell[0], counts.cell[1], counts.cell[2]);
            if (!delta.seeds.empty() && delta.seeds.back()->cell >= counts.cell)
                fail(ErrorKind::input, "{}: do not follow the ones before them", name);
            delta.seeds.push_back(takeSeeds(cursor, counts, name));
        }
    }
    if (cursor.left() != 0)
        fail(ErrorKind::input, "{}: {} bytes follow the last cell", place, cursor.left());
    delta.storage = file;
    return delta;
}

} // namespace sward::field
