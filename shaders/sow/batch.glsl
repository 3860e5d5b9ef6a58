// What the passes that grow units have in common.
#ifndef SWARD_SOW_BATCH_GLSL
#define SWARD_SOW_BATCH_GLSL

#include "shaders/shared/sow/sow_pass.h"

layout(push_constant, scalar) uniform Push { SowBatchPush push; };

/// A piece, its corners, and what all its candidates share: as in field::Sower.
struct Bearer {
    SeedPiece piece;
    SeedVertex a;
    SeedVertex b;
    SeedVertex c;
    uint back;
    uvec2 sequence;
};

Bearer bearerOf(SowCell cell, uint number, uint64_t seed)
{
    Bearer bearer;
    bearer.piece = cell.pieces.at[number];
    bearer.a = cell.vertices.at[bearer.piece.corners[0]];
    bearer.b = cell.vertices.at[bearer.piece.corners[1]];
    bearer.c = cell.vertices.at[bearer.piece.corners[2]];
    bearer.back = sowBack(bearer.piece);
    bearer.sequence = sowSequence(seed, bearer.piece.source, bearer.back);
    return bearer;
}

uint64_t keyOf(SeedPiece piece, uint candidate)
{
    return (uint64_t(piece.source) << 32) | uint64_t(candidate | (sowBack(piece) << 31u));
}

SeedConditions conditionsAt(SowCell cell, SeedPiece piece, SowPoint point)
{
    if (((piece.form >> 10u) & 0xffffu) == 0u)
        return cell.conditions.at[piece.records];
    const SowGridPlace place = sowGridPlace(piece, point);
    return sowConditions(cell.conditions.at[place.records[0]], cell.conditions.at[place.records[1]],
                         cell.conditions.at[place.records[2]], cell.conditions.at[place.records[3]], place);
}

#endif
