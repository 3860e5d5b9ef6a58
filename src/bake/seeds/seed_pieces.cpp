#include "bake/seeds/seed_pieces.h"

#include "core/error.h"
#include "shaders/shared/sow/sown_blade.h"

#include <cmath>

namespace sward::bake {
namespace {

constexpr double maxCandidatesOfSide = 2147483647.0;

// The lowest `bits` bits of x whose image under a map of low bits to low bits is `wanted`.
template <typename Map>
std::uint32_t invertLowBits(std::uint32_t wanted, std::uint32_t bits, Map map)
{
    std::uint32_t x = 0;
    for (std::uint32_t bit = 0; bit < bits; ++bit)
        if (((map(x) ^ wanted) >> bit & 1U) != 0)
            x |= 1U << bit;
    return x;
}

std::uint32_t reversedBits(std::uint32_t x, std::uint32_t bits)
{
    return bits == 0 ? 0 : shared::sowReverse(x) >> (32U - bits);
}

} // namespace

RootSample rootAt(const SeedPart& part, const TrianglePoints& points, double b, double c,
                  std::uint32_t number)
{
    return points.at(static_cast<float>(b), static_cast<float>(c),
                     number | (part.back != 0 ? backSide : 0U));
}

// The root at these shares of the way along s and v of a part.
RootSample rootOn(const SeedPart& part, const TrianglePoints& points,
                  const std::array<std::uint32_t, 2>& s, double alongS, double alongV,
                  std::uint32_t number)
{
    const double along = (double(s[0]) + double(s[1] - s[0]) * alongS) * 0x1p-32;
    const double across = std::ldexp(double(part.v) + alongV, -int(part.q));
    return rootAt(part, points, along * (1.0 - across), along * across, number);
}

shared::SeedPiece pieceOf(const terrain::GroundMesh& ground, std::uint64_t seed, double density,
                          const SeedPart& part)
{
    shared::SeedPiece piece = {};
    piece.source = ground.source(part.triangle);
    piece.bits = shared::noSeedBits;
    piece.creases = shared::noSeedBits;
    piece.form = part.p | part.q << 5U | part.back << 31U;
    piece.expected = static_cast<float>(density * ground.area(part.triangle));
    if (part.p + part.q > 0) {
        const glm::uvec2 sequence = shared::sowSequence(seed, piece.source, part.back);
        piece.low = invertLowBits(reversedBits(part.u, part.p), part.p, [&](std::uint32_t x) {
            return shared::sowScramble(x, sequence.x);
        });
        piece.target = invertLowBits(reversedBits(part.v, part.q), part.q, [&](std::uint32_t x) {
            return shared::sowScramble(x, sequence.y);
        });
    }
    piece.count = entriesOf(ground, seed, density, part, piece);
    return piece;
}

std::uint32_t entriesOf(const terrain::GroundMesh& ground, std::uint64_t seed, double density,
                        const SeedPart& part, const shared::SeedPiece& piece)
{
    const double area = ground.area(part.triangle);
    const double count =
        std::floor(density * area + roundingShare(seed, piece.source, part.back != 0));
    if (count > maxCandidatesOfSide)
        fail(ErrorKind::input,
             "--seeds: triangle {} of {:.6g} m² would bear {:.6g} blades, more than {}; divide "
             "the ground into smaller ones, or lower --density",
             piece.source, area, count, maxCandidatesOfSide);
    const auto all = static_cast<std::uint32_t>(count);
    if (part.p + part.q == 0)
        return all;
    const std::uint32_t whole = all >> (part.p + part.q);
    return whole + (shared::sowCandidate(piece, whole) < all ? 1 : 0);
}

// The image of a part is a quadrilateral.
DAabb boxOfPart(const terrain::GroundMesh& ground, const SeedPart& part)
{
    DAabb box;
    const glm::uvec3 corners = ground.triangles[part.triangle];
    for (glm::length_t k = 0; part.p + part.q == 0 && k < 3; ++k)
        box.add(glm::dvec3(ground.positions[corners[k]]));
    if (part.p + part.q == 0)
        return box;
    const TrianglePoints points(ground, part.triangle);
    const std::array<std::uint32_t, 2> s = rangeOfS(part);
    for (std::uint32_t i = 0; i < 4; ++i)
        box.add(glm::dvec3(rootOn(part, points, s, double(i & 1U), double(i >> 1U), 0).position));
    return box;
}

} // namespace sward::bake
