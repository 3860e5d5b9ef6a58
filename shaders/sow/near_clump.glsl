// The clump of a candidate: as field::NearClumps.
#ifndef SWARD_SOW_NEAR_CLUMP_GLSL
#define SWARD_SOW_NEAR_CLUMP_GLSL

uint listOf(ivec3 bucket, uint mask)
{
    const uint64_t xy = (uint64_t(uint(bucket.x)) << 32) | uint64_t(uint(bucket.y));
    return uint(sowHash(xy, uint64_t(uint(bucket.z))) & 0xfffffffful) & mask;
}

/// Half buckets up to a coordinate, rounded down.
int halvesOf(int x, int reach)
{
    return x >= 0 ? x / reach : -((reach - 1 - x) / reach);
}

SowClump nearestClump(SowMeadow meadow, SowCell cell, ivec3 place, uint64_t own)
{
    SowClump clump;
    clump.key = own;
    clump.offset = ivec3(0);
    clump.along = vec3(0.0f);
    clump.isAny = 0u;
    clump.wide.moisture = 0.0f;
    clump.wide.grazed = 0.0f;
    clump.wide.lain = 0.0f;
    clump.wide.towards = vec3(0.0f);
    if (cell.centreCount == 0u)
        return clump;
    const int reach = int(clamp(meadow.clumpReach, 1l, int64_t(1 << 28)));
    ivec3 bucket;
    ivec3 beside;
    for (int axis = 0; axis < 3; ++axis) {
        const int halves = halvesOf(place[axis], reach);
        bucket[axis] = halves >> 1;
        beside[axis] = (halves & 1) == 0 ? -1 : 1;
    }
    uint best = noSeedBits;
    uint64_t bestKey = 0ul;
    int64_t bestSquared = int64_t(reach) * int64_t(reach);
    for (int i = 0; i < 8; ++i) {
        const ivec3 at = bucket + ivec3(i & 1, (i >> 1) & 1, i >> 2) * beside;
        for (uint c = cell.heads.at[listOf(at, cell.headMask)]; c != noSeedBits;) {
            const SowCentre centre = cell.centres.at[c];
            const ivec3 offset = place - centre.place;
            const int64_t squared = int64_t(offset.x) * int64_t(offset.x) + int64_t(offset.y) * int64_t(offset.y) +
                                    int64_t(offset.z) * int64_t(offset.z);
            if (squared < bestSquared || (squared == bestSquared && best != noSeedBits && centre.key < bestKey)) {
                best = c;
                bestKey = centre.key;
                bestSquared = squared;
            }
            c = centre.next;
        }
    }
    if (best == noSeedBits)
        return clump;
    const SowCentre centre = cell.centres.at[best];
    clump.key = centre.key;
    clump.offset = place - centre.place;
    clump.isAny = 1u;
    const SeedPiece piece = cell.pieces.at[centre.piece];
    vec3 first;
    vec3 second;
    sowEdges(cell.vertices.at[piece.corners[0]], cell.vertices.at[piece.corners[1]],
             cell.vertices.at[piece.corners[2]], first, second);
    bool isShared = false;
    for (uint slot = 0u; slot < meadow.speciesCount; ++slot)
        isShared = isShared || meadow.species.at[slot].facing == sowShared;
    if (isShared)
        clump.along = sowClumpDirection(first, second, centre.key);
    if (meadow.wideVariation > 0.0f) {
        SeedClump seed;
        seed.piece = centre.piece;
        seed.number = 0u;
        seed.moisture = centre.moisture;
        clump.wide = sowClumpTraits(meadow, seed, centre.place, first, second, cell.ground, cell.waves);
    }
    return clump;
}

#endif
