// Blades beside convex creases fan out over the edge, as bake::CreaseBlend turns them.
#ifndef SWARD_SHARED_SOW_CREASES_H
#define SWARD_SHARED_SOW_CREASES_H

#include "shaders/shared/sow/vectors.h"

SHARED_BEGIN

/// Sums over the creases near a place.
struct SowFan {
    vec3 sum;      ///< of the normals beyond, weighted
    float weights; ///< their sum
    float largest; ///< of the weights
};

/// The crease that begins at a word of its cell.
SHARED_FN SeedCrease sowCreaseAt(SowWords words, uint first)
{
    SeedCrease crease;
    for (uint axis = 0u; axis < 3u; ++axis) {
        crease.from[axis] = int(words.at[first + axis]);
        crease.to[axis] = int(words.at[first + 3u + axis]);
    }
    crease.normals[0] = words.at[first + 6u];
    crease.normals[1] = words.at[first + 7u];
    return crease;
}

/// Adds a crease at a place of ground with the unit normal `own`.
SHARED_FN void sowAddCrease(SowMeadow meadow, SeedCrease crease, ivec3 place, vec3 own,
                            SHARED_INOUT(SowFan) fan)
{
    const ivec3 from = ivec3(crease.from[0], crease.from[1], crease.from[2]);
    vec3 offset;
    vec3 along;
    const uint shift = sowScaled(
        ivec3(place.x - from.x, place.y - from.y, place.z - from.z),
        ivec3(crease.to[0] - from.x, crease.to[1] - from.y, crease.to[2] - from.z), offset, along);
    const float unit = meadow.metresPerUnit * float(1u << shift);

    // From the nearest point of the crease.
    const float squared = sowDot(along, along);
    const float forward = sowDot(offset, along);
    const float share =
        squared > 0.0f && forward > 0.0f ? min(sowDivide(forward, squared), 1.0f) : 0.0f;
    offset = vec3((offset.x - share * along.x) * unit, (offset.y - share * along.y) * unit,
                  (offset.z - share * along.z) * unit);
    const float distance = sowSqrt(sowDot(offset, offset));
    const float reach = meadow.creaseReach;
    if (distance >= reach)
        return;
    vec3 here = sowUnitVector(sowUpOf(crease.normals[0]));
    vec3 beyond = sowUnitVector(sowUpOf(crease.normals[1]));
    if (sowDot(here, own) < sowDot(beyond, own)) {
        const vec3 other = here;
        here = beyond;
        beyond = other;
    }
    if (sowDot(here, own) < 0.7f || sowDot(offset, beyond) > 0.1f * reach ||
        abs(sowDot(offset, here)) > 0.5f * reach)
        return;
    const float nearness = 1.0f - sowDivide(distance, reach);
    const float weight = nearness * nearness;
    fan.sum = vec3(fan.sum.x + weight * beyond.x, fan.sum.y + weight * beyond.y,
                   fan.sum.z + weight * beyond.z);
    fan.weights += weight;
    fan.largest = max(fan.largest, weight);
}

/// A unit normal turned by the creases around it, and to the ground's up-vector by the alignment.
/// Of any length.
SHARED_FN vec3 sowFannedUp(SowMeadow meadow, vec3 own, SowFan fan, vec3 groundUp)
{
    vec3 turned = own;
    if (fan.weights > 0.0f) {
        const float inverse = sowDivide(1.0f, fan.weights);
        const vec3 mean = vec3(fan.sum.x * inverse, fan.sum.y * inverse, fan.sum.z * inverse);
        const float amount = meadow.creaseBlend * fan.largest *
                             min(sowDivide(1.0f, max(sowDot(mean, mean), 1e-12f)), 2.0f);
        const vec3 sum =
            vec3(own.x + amount * mean.x, own.y + amount * mean.y, own.z + amount * mean.z);
        if (sowDot(sum, sum) > 1e-12f)
            turned = sowUnitVector(sum);
    }
    const float level = 1.0f - meadow.vertical;
    const vec3 up = vec3(level * turned.x + meadow.vertical * groundUp.x,
                         level * turned.y + meadow.vertical * groundUp.y,
                         level * turned.z + meadow.vertical * groundUp.z);
    return sowDot(up, up) > 1e-12f ? up : turned;
}

/// Direction of growth at these weights of a piece's corners, of any length. `place` is theirs.
SHARED_FN vec3 sowUpAt(SowMeadow meadow, SeedPiece piece, uvec3 ups, uvec2 weights, ivec3 place,
                       SowWords words, SowGround ground)
{
    const vec3 between = sowUpBetween(ups.x, ups.y, ups.z, weights);
    if (piece.creases == noSeedBits)
        return between;
    const vec3 own = sowUnitVector(between);
    SowFan fan;
    fan.sum = vec3(0.0f, 0.0f, 0.0f);
    fan.weights = 0.0f;
    fan.largest = 0.0f;
    const uint count = words.at[piece.creases];
    for (uint i = 1u; i <= count; ++i)
        sowAddCrease(meadow, sowCreaseAt(words, words.at[piece.creases + i]), place, own, fan);
    return sowFannedUp(meadow, own, fan, sowGroundUp(ground, place, meadow.metresPerUnit));
}

SHARED_END
#endif
