#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Finds the candidates of a batch of units that grow: their ranks are those of the unit, they stand in its cube, and
// the conditions there let them grow. A work-group for each piece of a unit.
#include "shaders/sow/batch.glsl"

layout(local_size_x = sowFindThreads) in;

shared uint foundTogether;
shared uint firstTogether;

/// The first entry of a piece from `first` on whose rank is not below `rank`. Ranks rise with the entries.
uint entryOf(SeedPiece piece, float rounding, float perCandidate, uint first, float rank)
{
    uint end = piece.count;
    while (first < end) {
        const uint middle = first + (end - first) / 2u;
        if (sowRank(sowCandidate(piece, middle), rounding, perCandidate) < rank)
            first = middle + 1u;
        else
            end = middle;
    }
    return first;
}

/// Bits of three small numbers, interleaved.
uint mortonOf(uvec3 at)
{
    uint morton = 0u;
    for (uint bit = 0u; bit < 3u; ++bit)
        morton |= (((at.x >> bit) & 1u) | (((at.y >> bit) & 1u) << 1u) | (((at.z >> bit) & 1u) << 2u)) << (3u * bit);
    return morton;
}

void findIn(SowRun run, SowBatch batch)
{
    SowOrder unit = batch.units.at[run.unit];
    SowCell cell = unit.cell.at[0];
    const uint64_t seed = batch.meadow.at[0].seed;
    const uint unitBits = batch.meadow.at[0].unitBits;
    const Bearer bearer = bearerOf(cell, run.piece, seed);
    const SeedPiece piece = bearer.piece;
    const float rounding = sowRounding(seed, piece.source, bearer.back);
    const float perCandidate = sowDivide(1.0f, piece.expected);
    const uint first = unit.from > 0.0f ? entryOf(piece, rounding, perCandidate, 0u, unit.from) : 0u;
    const uint end = entryOf(piece, rounding, perCandidate, first, unit.share);

    for (uint base = first; base < end; base += sowFindThreads) {
        const uint j = base + gl_LocalInvocationID.x;
        SowRecord record;
        bool grows = false;
        if (j < end) {
            record.piece = run.piece;
            record.candidate = sowCandidate(piece, j);
            record.rank = sowRank(record.candidate, rounding, perCandidate);
            const SowPoint point = sowPoint(bearer.sequence, record.candidate);
            const ivec3 place = sowPlace(bearer.a, bearer.b, bearer.c, sowWeights(point));
            const ivec3 inside = place - unit.low;
            // A negative number has its highest bits set.
            const bool isInside = (uint(inside.x | inside.y | inside.z) >> unit.sideBits) == 0u;
            const uint cellBits = unitBits + 5u - unit.level;
            record.cell = sowCells * run.unit + mortonOf(uvec3(inside) >> cellBits);
            if (isInside)
                grows = piece.bits != noSeedBits ?
                            ((cell.words.at[piece.bits + j / 32u] >> (j % 32u)) & 1u) != 0u :
                            sowGrows(conditionsAt(cell, piece, point), sowHash(seed, keyOf(piece, record.candidate)));
        }
        // One place in the list for all that grow.
        if (gl_LocalInvocationID.x == 0u)
            foundTogether = 0u;
        barrier();
        const uint own = grows ? atomicAdd(foundTogether, 1u) : 0u;
        barrier();
        if (gl_LocalInvocationID.x == 0u)
            firstTogether = atomicAdd(batch.counts.at[0].records, foundTogether);
        barrier();
        if (grows && firstTogether + own < batch.maxRecords) {
            batch.records.at[firstTogether + own] = record;
            atomicAdd(batch.cells.at[record.cell], 1u);
        } else if (grows) {
            batch.failed.at[run.unit] = 1u;
        }
        barrier();
    }
}

void main()
{
    SowBatch batch = push.batch.at[0];
    for (uint run = gl_WorkGroupID.x; run < batch.runCount; run += gl_NumWorkGroups.x)
        findIn(batch.runs.at[run], batch);
}
