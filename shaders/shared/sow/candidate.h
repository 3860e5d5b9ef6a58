// Candidates of a bearing triangle: where they stand, and in which order they grow.
#ifndef SWARD_SHARED_SOW_CANDIDATE_H
#define SWARD_SHARED_SOW_CANDIDATE_H

#include "shaders/shared/sow/exact.h"
#include "shaders/shared/sow/seeds.h"

SHARED_BEGIN

SHARED_FN uint sowReverse(uint x)
{
    x = ((x & 0x55555555u) << 1u) | ((x >> 1u) & 0x55555555u);
    x = ((x & 0x33333333u) << 2u) | ((x >> 2u) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4u) | ((x >> 4u) & 0x0f0f0f0fu);
    x = ((x & 0x00ff00ffu) << 8u) | ((x >> 8u) & 0x00ff00ffu);
    return (x << 16u) | (x >> 16u);
}

/// Scrambles from the low bits up: bit k of the result depends on the bits up to k.
SHARED_FN uint sowScramble(uint x, uint seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Pascal's triangle modulo 2: of the polynomial f over GF(2) with the bits of `x`, f(z + 1).
SHARED_FN uint sowPascal(uint x)
{
    x ^= (x & 0xaaaaaaaau) >> 1u;
    x ^= (x & 0xccccccccu) >> 2u;
    x ^= (x & 0xf0f0f0f0u) >> 4u;
    x ^= (x & 0xff00ff00u) >> 8u;
    x ^= x >> 16u;
    return x;
}

/// Seeds of the scrambling of u and v on a triangle side: those of bake::TriangleSequence.
SHARED_FN uvec2 sowSequence(uint64_t seed, uint source, uint back)
{
    const uint64_t bits = sowHash(seed ^ 0x706c616365ul, uint64_t(source) | (uint64_t(back) << 32));
    return uvec2(uint(bits & 0xfffffffful), sowUpper(bits));
}

/// The share that rounds the expected number of candidates, as bake::roundingShare(), a multiple of
/// 2⁻²⁴.
SHARED_FN float sowRounding(uint64_t seed, uint source, uint back)
{
    const uint64_t side = uint64_t(back) << 32;
    const uint64_t group =
        sowHash(seed ^ 0x636f756e74ul, uint64_t(source >> 4u) | side | 0x200000000ul);
    const uint low = uint(group & 0xfffffffful);
    const uint turned = ((low & 7u) * 2u + 1u) * (source & 15u) + ((low >> 3u) & 15u);
    const uint stratum = (sowReverse(turned & 15u) >> 28u) ^ ((low >> 7u) & 15u);
    const uint jitter = sowUpper(sowHash(seed ^ 0x636f756e74ul, uint64_t(source) | side)) >> 12u;
    return float((stratum << 20u) | jitter) * 5.9604644775390625e-8f;
}

SHARED_FN uint sowBack(SeedPiece piece)
{
    return piece.form >> 31u;
}

/// Candidate number of entry `j` of a piece. Of all numbers with the piece's lowest p bits, which
/// fix the leading bits of u, one in 2^q has the leading bits of v. As polynomials over GF(2):
/// f ≡ low modulo z^p and f ≡ target modulo (z + 1)^q; the rest of f is `j`. With w = z + 1 and
/// (1 + w)^32 ≡ 1 modulo w^q, the power (1 + w)^−p is (1 + w)^(32 − p).
SHARED_FN uint sowCandidate(SeedPiece piece, uint j)
{
    const uint p = piece.form & 31u;
    const uint q = (piece.form >> 5u) & 31u;
    if (p + q == 0u)
        return j;
    const uint known = (j << (p + q)) | piece.low;
    const uint mask = (1u << q) - 1u;
    const uint rest = (piece.target ^ sowPascal(known)) & mask;
    const uint power = 32u - p;
    uint product = 0u;
    for (uint k = 0u; k < q; ++k)
        if ((k & ~power) == 0u)
            product ^= rest << k;
    return known | (sowPascal(product & mask) << p);
}

/// A candidate's point of the unit square, u by its root: s = √u.
struct SowPoint {
    uint s; ///< [2⁻³²]
    uint v; ///< [2⁻³²], and half of one
};

SHARED_FN SowPoint sowPoint(uvec2 sequence, uint candidate)
{
    SowPoint point;
    const uint u = sowReverse(sowScramble(candidate, sequence.x));
    point.s = sowWholeSqrt((uint64_t(u) << 32) | 0x80000000ul);
    point.v = sowReverse(sowScramble(sowPascal(candidate), sequence.y));
    return point;
}

/// The same for a random pair (of a clump centre).
SHARED_FN SowPoint sowRandomPoint(uint u, uint v)
{
    SowPoint point;
    point.s = sowWholeSqrt((uint64_t(u) << 32) | 0x80000000ul);
    point.v = v;
    return point;
}

/// Weights [2⁻³²] of the triangle's second and third corner.
SHARED_FN uvec2 sowWeights(SowPoint point)
{
    const uint third =
        uint((uint64_t(point.s) * uint64_t(point.v) + uint64_t(point.s >> 1u)) >> 32);
    return uvec2(point.s - third, third);
}

/// A coordinate at these weights, rounded down.
SHARED_FN int sowBetween(int a, int b, int c, uvec2 weights)
{
    const int64_t sum = int64_t(weights.x) * (int64_t(b) - int64_t(a)) +
                        int64_t(weights.y) * (int64_t(c) - int64_t(a));
    return a + int(sum >> 32);
}

/// A place of a triangle.
SHARED_FN ivec3 sowPlace(SeedVertex a, SeedVertex b, SeedVertex c, uvec2 weights)
{
    return ivec3(sowBetween(a.x, b.x, c.x, weights), sowBetween(a.y, b.y, c.y, weights),
                 sowBetween(a.z, b.z, c.z, weights));
}

/// Whether a place lies in the cell: from its low corner up to its high one.
SHARED_FN bool sowInCell(ivec3 place, uint unitBits)
{
    const int side = 1 << int(unitBits + 5u);
    return place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < side && place.y < side &&
           place.z < side;
}

/// Rank of a candidate in [0, 1): the share of the density at which ⌊λA + u⌋ would include it.
/// Every prefix of ranks is the uniform bake of that lower density. `perCandidate` is 1 / λA.
SHARED_FN float sowRank(uint candidate, float rounding, float perCandidate)
{
    const float rank =
        (float(candidate >> 8u) * 256.0f + float(candidate & 255u) + 1.0f - rounding) *
        perCandidate;
    return clamp(rank, 0.0f, 0.99999994f);
}

/// Level of a rank, 0 to `levels`: level l > 0 has the ranks from 4^(l − 1 − levels) to below
/// 4^(l − levels), level 0 those below. It grows in octree cells of 32 m / 2^l.
SHARED_FN uint sowLevel(float rank, uint levels)
{
    uint level = levels;
    float low = 0.25f;
    while (level > 0u && rank < low) {
        low *= 0.25f;
        --level;
    }
    return level;
}

SHARED_END
#endif
