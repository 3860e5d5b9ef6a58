// Conditions of a candidate: those of its piece, between the points of their grid.
#ifndef SWARD_SHARED_SOW_CONDITIONS_H
#define SWARD_SHARED_SOW_CONDITIONS_H

#include "shaders/shared/sow/candidate.h"

SHARED_BEGIN

/// Four neighbouring points of a piece's grid and their weights, which sum up to 65536.
struct SowGridPlace {
    uint records[4];
    uint weights[4];
};

SHARED_FN uint sowStepsAlongS(SeedPiece piece)
{
    return (piece.form >> 10u) & 255u;
}

SHARED_FN uint sowStepsAlongV(SeedPiece piece)
{
    return (piece.form >> 18u) & 255u;
}

SHARED_FN SowGridPlace sowGridPlace(SeedPiece piece, SowPoint point)
{
    const uint alongS = sowStepsAlongS(piece);
    const uint alongV = sowStepsAlongV(piece);
    const uint q = (piece.form >> 5u) & 31u;
    // In steps of the grid, with sixteen bits behind the point.
    const uint s =
        uint((uint64_t(point.s - min(point.s, piece.sStart)) * uint64_t(piece.sScale)) >> 32);
    const uint v = uint((uint64_t(point.v << q) * uint64_t(alongV)) >> 16);
    const uint column = min(s >> 16u, alongS);
    const uint row = min(v >> 16u, alongV);
    const uint nextColumn = min(column + 1u, alongS);
    const uint nextRow = min(row + 1u, alongV);
    const uint a = s >> 16u > alongS ? 0u : (s >> 8u) & 255u;
    const uint b = (v >> 8u) & 255u;
    const uint width = alongS + 1u;
    SowGridPlace place;
    place.records[0] = piece.records + row * width + column;
    place.records[1] = piece.records + row * width + nextColumn;
    place.records[2] = piece.records + nextRow * width + column;
    place.records[3] = piece.records + nextRow * width + nextColumn;
    place.weights[0] = (256u - a) * (256u - b);
    place.weights[1] = a * (256u - b);
    place.weights[2] = (256u - a) * b;
    place.weights[3] = a * b;
    return place;
}

/// The bits `first` to `first` + `count` of four words, weighted and rounded.
SHARED_FN uint sowBlend(uvec4 words, SowGridPlace place, uint first, uint count)
{
    const uint mask = (1u << count) - 1u;
    const uint sum = ((words.x >> first) & mask) * place.weights[0] +
                     ((words.y >> first) & mask) * place.weights[1] +
                     ((words.z >> first) & mask) * place.weights[2] +
                     ((words.w >> first) & mask) * place.weights[3];
    return (sum + 32768u) >> 16u;
}

/// Four bytes of four words.
SHARED_FN uint sowBlendBytes(uvec4 words, SowGridPlace place)
{
    return sowBlend(words, place, 0u, 8u) | (sowBlend(words, place, 8u, 8u) << 8u) |
           (sowBlend(words, place, 16u, 8u) << 16u) | (sowBlend(words, place, 24u, 8u) << 24u);
}

/// A half word and two bytes of four words.
SHARED_FN uint sowBlendHalf(uvec4 words, SowGridPlace place)
{
    return sowBlend(words, place, 0u, 16u) | (sowBlend(words, place, 16u, 8u) << 16u) |
           (sowBlend(words, place, 24u, 8u) << 24u);
}

/// Conditions between four points of a grid.
SHARED_FN SeedConditions sowConditions(SeedConditions a, SeedConditions b, SeedConditions c,
                                       SeedConditions d, SowGridPlace place)
{
    SeedConditions between;
    between.growth = sowBlendHalf(uvec4(a.growth, b.growth, c.growth, d.growth), place);
    between.look = sowBlendBytes(uvec4(a.look, b.look, c.look, d.look), place);
    between.size = sowBlendHalf(uvec4(a.size, b.size, c.size, d.size), place);
    between.lean = sowBlendBytes(uvec4(a.lean, b.lean, c.lean, d.lean), place);
    for (int i = 0; i < 2; ++i) {
        between.share[i] =
            sowBlendBytes(uvec4(a.share[i], b.share[i], c.share[i], d.share[i]), place);
        between.vigour[i] =
            sowBlendBytes(uvec4(a.vigour[i], b.vigour[i], c.vigour[i], d.vigour[i]), place);
    }
    return between;
}

// Purpose of the random number that decides whether a candidate grows, as bake::Dimension.
SHARED_CONST uint sowChanceDice = 2u;

/// Whether a candidate grows. `own` is the hash of seed and key.
SHARED_FN bool sowGrows(SeedConditions conditions, uint64_t own)
{
    const uint density = conditions.growth & 65535u;
    return density == 65535u || (density << 16u) > sowUpper(sowHash(own, uint64_t(sowChanceDice)));
}

SHARED_END
#endif
