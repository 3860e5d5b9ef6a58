#include "field/seeds/changed_cubes.h"

#include "shaders/shared/sow/sown_blade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <vector>

namespace sward::field {
namespace {

// What tells a piece from all others of a cell: a triangle, and the part of it.
using PieceName = std::array<std::uint32_t, 4>;

PieceName nameOf(const shared::SeedPiece& piece)
{
    constexpr std::uint32_t partBits = 1023U | 1U << 31U;
    return {piece.source, piece.form & partBits, piece.low, piece.target};
}

std::map<PieceName, std::uint32_t> bearingOf(const SeedCell& cell)
{
    std::map<PieceName, std::uint32_t> found;
    for (std::uint32_t i = 0; i < cell.pieces.size(); ++i)
        if (cell.pieces[i].count > 0)
            found.emplace(nameOf(cell.pieces[i]), i);
    return found;
}

template <typename T>
bool haveSame(const std::vector<T>& a, std::size_t firstA, const std::vector<T>& b,
              std::size_t firstB, std::size_t count)
{
    return std::memcmp(a.data() + firstA, b.data() + firstB, count * sizeof(T)) == 0;
}

bool haveSameCreases(const SeedCell& a, std::uint32_t listA, const SeedCell& b, std::uint32_t listB)
{
    if (listA == shared::noSeedBits || listB == shared::noSeedBits)
        return listA == listB;
    if (a.words[listA] != b.words[listB])
        return false;
    for (std::uint32_t i = 1; i <= a.words[listA]; ++i)
        if (!haveSame(a.words, a.words[listA + i], b.words, b.words[listB + i],
                      shared::seedCreaseWords))
            return false;
    return true;
}

bool areSame(const SeedCell& a, const shared::SeedPiece& x, const SeedCell& b,
             const shared::SeedPiece& y)
{
    if (x.count != y.count || x.form != y.form || x.sStart != y.sStart || x.sScale != y.sScale ||
        (x.bits == shared::noSeedBits) != (y.bits == shared::noSeedBits))
        return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (!haveSame(a.vertices, x.corners[k], b.vertices, y.corners[k], 1))
            return false;
    const std::size_t points =
        std::size_t((x.form >> 10U & 255U) + 1) * ((x.form >> 18U & 255U) + 1);
    return haveSame(a.conditions, x.records, b.conditions, y.records, points) &&
           (x.bits == shared::noSeedBits ||
            haveSame(a.words, x.bits, b.words, y.bits, (std::size_t(x.count) + 31) / 32)) &&
           haveSameCreases(a, x.creases, b, y.creases);
}

bool haveSameClumps(const SeedCell& a, const SeedCell& b)
{
    return std::equal(a.clumps.begin(), a.clumps.end(), b.clumps.begin(), b.clumps.end(),
                      [&](const shared::SeedClump& x, const shared::SeedClump& y) {
                          return a.pieces[x.piece].source == b.pieces[y.piece].source &&
                                 x.number == y.number && x.moisture == y.moisture;
                      });
}

float heightScaleOf(const SeedCell& cell)
{
    float scale = 1.0f;
    for (const shared::SeedPiece& piece : cell.pieces)
        if (piece.count > 0)
            scale = std::min(scale, shared::sowHeightScale(piece));
    return scale;
}

} // namespace

UnitCell::Cubes changedCubes(const SeedCell& before, const SeedCell& after, std::uint32_t unitBits)
{
    if (heightScaleOf(before) != heightScaleOf(after) || !haveSameClumps(before, after))
        return cubesOf(before, unitBits) | cubesOf(after, unitBits);
    UnitCell::Cubes changed;
    std::map<PieceName, std::uint32_t> left = bearingOf(before);
    for (const auto& [name, index] : bearingOf(after)) {
        const shared::SeedPiece& piece = after.pieces[index];
        const auto former = left.find(name);
        if (former != left.end() && areSame(before, before.pieces[former->second], after, piece)) {
            left.erase(former);
            continue;
        }
        changed |= cubesOf(after, piece, unitBits);
    }
    for (const auto& [name, index] : left)
        changed |= cubesOf(before, before.pieces[index], unitBits);
    return changed;
}

} // namespace sward::field
