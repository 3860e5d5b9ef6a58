// Sows every candidate of a piece, as field::Sower does.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shaders/shared/sow/sown_blade.h"

SHARED_BUFFER(Meadows, SowMeadow, readonly)
SHARED_BUFFER(Pieces, SeedPiece, readonly)
SHARED_BUFFER(Vertices, SeedVertex, readonly)
SHARED_BUFFER(ConditionList, SeedConditions, readonly)
SHARED_BUFFER(SownBlades, PackedBlade, writeonly)

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push
{
    Meadows meadow;
    Pieces piece;
    Vertices vertices;
    ConditionList conditions;
    SowWaves waves;
    SowWords words;
    SowTones tones;
    SownBlades blades;
} push;

void main()
{
    const uint j = gl_GlobalInvocationID.x;
    SowMeadow meadow = push.meadow.at[0];
    const SeedPiece piece = push.piece.at[0];
    if (j >= piece.count)
        return;
    const SeedVertex a = push.vertices.at[piece.corners[0]];
    const SeedVertex b = push.vertices.at[piece.corners[1]];
    const SeedVertex c = push.vertices.at[piece.corners[2]];
    const uint candidate = sowCandidate(piece, j);
    const SowPoint point = sowPoint(sowSequence(meadow.seed, piece.source, 0u), candidate);
    const uvec2 weights = sowWeights(point);
    const uint64_t key = (uint64_t(piece.source) << 32) | uint64_t(candidate);
    SowRoot root;
    root.own = sowHash(meadow.seed, key);
    root.hash = uint(sowHash(meadow.seed + 1ul, key) & 15ul);
    root.place = sowPlace(a, b, c, weights);
    SowGround ground;
    ground.up = vec3(3.0f, 2.0f, -1.0f);
    ground.isRadial = 1u;
    root.up = sowUpAt(meadow, piece, uvec3(a.up, b.up, c.up), weights, root.place, push.words,
                      ground);
    sowEdges(a, b, c, root.first, root.second);
    const float rank = sowRank(candidate, sowRounding(meadow.seed, piece.source, 0u),
                               sowDivide(1.0f, piece.expected));
    root.level = sowLevel(rank, meadow.levels);
    // One of three clumps, or none.
    SowClump clump;
    clump.key = root.own;
    clump.offset = ivec3(0, 0, 0);
    clump.along = vec3(0.0f, 0.0f, 0.0f);
    clump.isAny = 0u;
    clump.wide.moisture = 0.0f;
    clump.wide.grazed = 0.0f;
    clump.wide.lain = 0.0f;
    clump.wide.towards = vec3(0.0f, 0.0f, 0.0f);
    if ((candidate & 3u) != 0u) {
        clump.key = sowClumpKey(meadow.clumpKey, piece.source, candidate & 3u);
        const ivec3 centre = sowClumpPlace(a, b, c, clump.key);
        clump.offset = root.place - centre;
        SeedClump seed;
        seed.moisture = int(candidate & 0x3fffu) - 8192;
        clump.wide = sowClumpTraits(meadow, seed, centre, root.first, root.second, ground,
                                    push.waves);
        clump.along = sowClumpDirection(root.first, root.second, clump.key);
        clump.isAny = 1u;
    }
    const SowGridPlace grid = sowGridPlace(piece, point);
    const SeedConditions conditions = sowConditions(
        push.conditions.at[grid.records[0]], push.conditions.at[grid.records[1]],
        push.conditions.at[grid.records[2]], push.conditions.at[grid.records[3]], grid);
    const SownBlade blade = sowBlade(meadow, root, clump, conditions, push.waves, push.tones);
    push.blades.at[2u * j] = sowRibbon(meadow, blade, 1u, 0.5f, 0.25f);
    push.blades.at[2u * j + 1u] = blade.bits;
    if (!sowGrows(conditions, root.own))
        push.blades.at[2u * j].look = 0xffffffffu;
}
