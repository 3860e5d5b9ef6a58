#include "core/error.h"
#include "core/expect.h"
#include "field/file/compression.h"
#include "field/seeds/seeds.h"
#include "shaders/shared/sow/conditions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace sward::field {
namespace {

// Coordinates of vertices lie within this many units of the cell's corner.
constexpr std::int32_t farthestUnit = (1 << 30) - 1;
constexpr std::uint32_t finestPieceBits = 30;
constexpr std::uint64_t maxCandidatesOfPiece = 1ULL << 31U;
constexpr double maxDensityOfPiece = 8.0; // as bake::maxPaintedDensity
constexpr std::int32_t maxMoisture = 1 << 15;

// Words of one element as they are stored: where no species is mixed, conditions leave their last
// four out.
constexpr std::size_t vertexWords = sizeof(shared::SeedVertex) / 4;
constexpr std::size_t pieceWords = sizeof(shared::SeedPiece) / 4;
constexpr std::size_t clumpWords = sizeof(shared::SeedClump) / 4;
std::size_t conditionWords(bool isMixed)
{
    return isMixed ? 8 : 4;
}

// Words are stored by their place in an element: the first of all elements, the second, and so on,
// each less the one before it. Neighbours resemble each other.
template <typename T>
std::uint32_t* putWords(const std::vector<T>& elements, std::size_t words, std::uint32_t* to)
{
    for (std::size_t word = 0; word < words; ++word) {
        std::uint32_t last = 0;
        for (const T& element : elements) {
            std::uint32_t value = 0;
            std::memcpy(&value, reinterpret_cast<const std::byte*>(&element) + 4 * word, 4);
            *to++ = value - last;
            last = value;
        }
    }
    return to;
}

template <typename T>
const std::uint32_t* takeWords(std::vector<T>& elements, std::size_t words,
                               const std::uint32_t* from)
{
    for (std::size_t word = 0; word < words; ++word) {
        std::uint32_t last = 0;
        for (T& element : elements) {
            last += *from++;
            std::memcpy(reinterpret_cast<std::byte*>(&element) + 4 * word, &last, 4);
        }
    }
    return from;
}

std::uint64_t wordsOf(const SeedEntry& entry, bool isMixed)
{
    return std::uint64_t(entry.vertices) * vertexWords + std::uint64_t(entry.pieces) * pieceWords +
           std::uint64_t(entry.clumps) * clumpWords +
           std::uint64_t(entry.conditions) * conditionWords(isMixed) + entry.words;
}

bool isNear(std::int32_t x)
{
    return x >= -farthestUnit && x <= farthestUnit;
}

// Whether the list of creases at a word, and the creases, lie in the words.
bool areCreasesValid(const std::vector<std::uint32_t>& words, std::size_t list)
{
    if (list >= words.size() || words[list] > words.size() - list - 1)
        return false;
    for (std::size_t i = 1; i <= words[list]; ++i) {
        const std::size_t first = words[list + i];
        if (first + shared::seedCreaseWords > words.size())
            return false;
        for (std::size_t axis = 0; axis < 6; ++axis)
            if (!isNear(static_cast<std::int32_t>(words[first + axis])))
                return false;
    }
    return true;
}

void verifyPiece(const shared::SeedPiece& piece, const SeedCell& cell, std::size_t index,
                 const std::string& place)
{
    const auto refuse = [&](const char* what) {
        fail(ErrorKind::input, "{}: piece {} of the seeds has {}", place, index, what);
    };
    for (const std::uint32_t corner : piece.corners)
        if (corner >= cell.vertices.size())
            refuse("a corner without a vertex");
    if (piece.count == 0)
        return;
    const std::uint32_t p = piece.form & 31U;
    const std::uint32_t q = piece.form >> 5U & 31U;
    if (p + q > finestPieceBits || piece.count > maxCandidatesOfPiece >> (p + q) ||
        piece.low >> p != 0 || piece.target >> q != 0)
        refuse("candidates out of range");
    if (!(piece.expected >= 1e-30f && piece.expected <= 0x1p32f))
        refuse("no valid number of candidates");
    // ⌊expected + u⌋ of the whole triangle, of which a part has one in 2^(p + q). Strokes ask for
    // more, candidate by candidate.
    constexpr double rounding = 1e-6; // relative, of a float
    const double whole = std::ldexp(double(piece.count), static_cast<int>(p + q));
    const double slack =
        std::ldexp(1.0, static_cast<int>(p + q)) + rounding * (double(piece.expected) + 1.0);
    const double most =
        (piece.bits != shared::noSeedBits ? maxDensityOfPiece : 1.0) * double(piece.expected);
    if (whole < double(piece.expected) - slack || whole > most + slack)
        refuse("a number of candidates that does not fit the expected one");
    const std::uint64_t points =
        std::uint64_t((piece.form >> 10U & 255U) + 1) * ((piece.form >> 18U & 255U) + 1);
    if (piece.records + points > cell.conditions.size())
        refuse("conditions that are missing");
    if (piece.bits != shared::noSeedBits &&
        piece.bits + (std::uint64_t(piece.count) + 31) / 32 > cell.words.size())
        refuse("bits that are missing");
    if (piece.creases != shared::noSeedBits && !areCreasesValid(cell.words, piece.creases))
        refuse("creases that are missing or too far from the cell");
}

} // namespace

SeedsView viewOf(const Seeds& seeds)
{
    return {&seeds.meadow, seeds.cells, seeds.data, seeds.elsewhere};
}

SeedEntry entryOf(const SeedCell& cell)
{
    SeedEntry entry{};
    entry.cell = cell.cell;
    entry.vertices = static_cast<std::uint32_t>(cell.vertices.size());
    entry.pieces = static_cast<std::uint32_t>(cell.pieces.size());
    entry.clumps = static_cast<std::uint32_t>(cell.clumps.size());
    entry.conditions = static_cast<std::uint32_t>(cell.conditions.size());
    entry.words = static_cast<std::uint32_t>(cell.words.size());
    return entry;
}

UninitializedVector<std::byte> packSeedCell(const SeedCell& cell, bool isMixed)
{
    // Where strokes sow species.
    isMixed =
        isMixed || std::any_of(cell.conditions.begin(), cell.conditions.end(), [](const auto& one) {
            return (one.share[0] | one.share[1] | one.vigour[0] | one.vigour[1]) != 0;
        });
    std::vector<std::uint32_t> words(wordsOf(entryOf(cell), isMixed));
    std::uint32_t* to = words.data();
    to = putWords(cell.vertices, vertexWords, to);
    to = putWords(cell.pieces, pieceWords, to);
    to = putWords(cell.clumps, clumpWords, to);
    to = putWords(cell.conditions, conditionWords(isMixed), to);
    std::copy(cell.words.begin(), cell.words.end(), to);
    return compress(std::as_bytes(std::span(words)), sizeof(std::uint32_t));
}

void addSeedCell(Seeds& seeds, SeedEntry entry, std::span<const std::byte> packed)
{
    expect(seeds.cells.empty() || seeds.cells.back().cell < entry.cell, "cells in rising order");
    entry.offset = seeds.data.size();
    entry.bytes = packed.size();
    seeds.cells.push_back(entry);
    seeds.data.insert(seeds.data.end(), packed.begin(), packed.end());
}

void addSeedCell(Seeds& seeds, const SeedCell& cell)
{
    addSeedCell(seeds, entryOf(cell), packSeedCell(cell, seeds.meadow.isMixed));
}

SeedCell readSeedCell(const SeedsView& seeds, std::size_t index, const std::string& place)
{
    const SeedEntry& entry = seeds.cells[index];
    const std::string name = fmt::format("{}: seeds of cell ({}, {}, {})", place, entry.cell[0],
                                         entry.cell[1], entry.cell[2]);
    const auto stored = seeds.data.subspan(entry.offset, entry.bytes);
    const bool isMixed = seeds.meadow->isMixed ||
                         claimedBytes(stored) == wordsOf(entry, true) * sizeof(std::uint32_t);
    const std::uint64_t count = wordsOf(entry, isMixed);
    checkClaim(stored, count * sizeof(std::uint32_t), name);
    std::vector<std::uint32_t> words(count);
    decompress(stored, sizeof(std::uint32_t), std::as_writable_bytes(std::span(words)), name);

    SeedCell cell;
    cell.cell = entry.cell;
    cell.vertices.resize(entry.vertices);
    cell.pieces.resize(entry.pieces);
    cell.clumps.resize(entry.clumps);
    cell.conditions.resize(entry.conditions);
    const std::uint32_t* from = words.data();
    from = takeWords(cell.vertices, vertexWords, from);
    from = takeWords(cell.pieces, pieceWords, from);
    from = takeWords(cell.clumps, clumpWords, from);
    from = takeWords(cell.conditions, conditionWords(isMixed), from);
    cell.words.assign(from, from + entry.words);

    verifySeedCell(cell, name);
    return cell;
}

void verifySeedCell(const SeedCell& cell, const std::string& place)
{
    for (std::size_t i = 0; i < cell.vertices.size(); ++i)
        if (!isNear(cell.vertices[i].x) || !isNear(cell.vertices[i].y) ||
            !isNear(cell.vertices[i].z))
            fail(ErrorKind::input, "{}: vertex {} is too far from the cell", place, i);
    for (std::size_t i = 0; i < cell.pieces.size(); ++i)
        verifyPiece(cell.pieces[i], cell, i, place);
    for (std::size_t i = 0; i < cell.clumps.size(); ++i)
        if (cell.clumps[i].piece >= cell.pieces.size())
            fail(ErrorKind::input, "{}: clump {} lies on piece {}; there are {}", place, i,
                 cell.clumps[i].piece, cell.pieces.size());
    for (std::size_t i = 0; i < cell.clumps.size(); ++i)
        if (std::abs(cell.clumps[i].moisture) > maxMoisture)
            fail(ErrorKind::input, "{}: clump {} has moisture {}, beyond {}", place, i,
                 cell.clumps[i].moisture, maxMoisture);
}

void verifySeeds(const SeedsView& seeds, std::size_t speciesCount, const std::string& place)
{
    if (seeds.meadow->species.size() != speciesCount)
        fail(ErrorKind::input, "{}: the seeds have {} species, of {} that there are", place,
             seeds.meadow->species.size(), speciesCount);
    std::uint64_t at = 0;
    for (std::size_t i = 0; i < seeds.cells.size(); ++i) {
        const SeedEntry& entry = seeds.cells[i];
        if (i > 0 && !(seeds.cells[i - 1].cell < entry.cell))
            fail(ErrorKind::input, "{}: cell {} of the seeds is out of order", place, i);
        if (entry.offset != at || entry.bytes > seeds.bytes() - at)
            fail(ErrorKind::input, "{}: cell {} of the seeds, {} bytes at {}, does not fit", place,
                 i, entry.bytes, entry.offset);
        at += entry.bytes;
    }
    if (at != seeds.bytes())
        fail(ErrorKind::input, "{}: bytes follow the last cell of the seeds", place);
}

} // namespace sward::field
