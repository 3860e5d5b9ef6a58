#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Grows the stalks of a batch, a thread each: as field::Sower, byte for byte.
#include "shaders/sow/batch.glsl"
#include "shaders/sow/near_clump.glsl"

layout(local_size_x = sowGrowThreads) in;

SowStalk stalkOf(SowBatch batch, SowCell cell, SowRecord record, uint level)
{
    SowMeadow meadow = batch.meadow.at[0];
    meadow.heightsPerMetre *= cell.heightScale;
    const Bearer bearer = bearerOf(cell, record.piece, meadow.seed);
    const SowPoint point = sowPoint(bearer.sequence, record.candidate);
    const uvec2 weights = sowWeights(point);
    const uint64_t key = keyOf(bearer.piece, record.candidate);
    SowRoot root;
    root.own = sowHash(meadow.seed, key);
    root.hash = uint(sowHash(meadow.seed + 1ul, key) & 15ul);
    root.place = sowPlace(bearer.a, bearer.b, bearer.c, weights);
    root.up = sowUpAt(meadow, bearer.piece, uvec3(bearer.a.up, bearer.b.up, bearer.c.up), weights, root.place,
                      cell.words, cell.ground);
    sowEdges(bearer.a, bearer.b, bearer.c, root.first, root.second);
    root.level = level;
    const SownBlade sown = sowBlade(meadow, root, nearestClump(meadow, cell, root.place, root.own),
                                    conditionsAt(cell, bearer.piece, point), cell.waves, batch.tones);
    SowStalk stalk;
    stalk.bits = sown.bits;
    stalk.height = sown.height;
    return stalk;
}

void main()
{
    SowBatch batch = push.batch.at[0];
    const uint i = gl_GlobalInvocationID.x;
    if (i >= min(batch.counts.at[0].records, batch.maxRecords))
        return;
    const SowRecord record = batch.sorted.at[i];
    SowOrder unit = batch.units.at[record.cell / sowCells];
    batch.stalks.at[i] = stalkOf(batch, unit.cell.at[0], record, unit.level);
}
