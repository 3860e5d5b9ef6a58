#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Moves the blades of one patch, judges each, and lists those that are to be drawn. One work-group
// per patch that owns blades; survivors gather in shared memory, so that a patch costs one atomic
// on the list. Nothing here depends on the size of a subgroup.
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"

layout(local_size_x = updateThreads) in;
layout(push_constant, scalar) uniform Block { UpdatePush push; };
#define FRAME push.frame.at[0]

#include "shaders/culling/hidden.glsl"

// Known when the pipeline is made, so that winds that do not blow and colliders that are not there
// cost nothing.
layout(constant_id = 0) const uint windCounts = 0u;
layout(constant_id = 1) const bool hasColliders = false;

shared uint fateTally[fateCount];
shared uint listBase;
shared VisibleBlade survivors[maxPatchBlades];
shared uint colliderBits[colliderWords];

/// The colliders that may touch a blade of the patch, found by all threads together.
ColliderMask collidersNear(Patch cell, float elapsed, uint thread)
{
    ColliderMask near = noColliders();
    if (!hasColliders || elapsed <= 0.0f)
        return near;
    if (thread < colliderWords)
        colliderBits[thread] = 0u;
    barrier();
    for (uint i = thread; i < FRAME.nature.colliderCount; i += updateThreads)
        if (colliderNear(FRAME.nature.colliders.at[i], cell.boundsLow, cell.boundsHigh, elapsed))
            atomicOr(colliderBits[i / 32u], 1u << (i % 32u));
    barrier();
    for (uint word = 0u; word < colliderWords; ++word)
        near.words[word] = colliderBits[word];
    return near;
}

/// Whether the ground hides all blades of a patch.
bool patchHidden(Eyepoint view, Patch cell)
{
    if ((view.cullMask & cullPatch) == 0u || (view.cullMask & cullOcclusion) == 0u)
        return false;
    const vec3 margin = vec3(patchMargin(view, cell));
    return isHidden(cell.boundsLow - margin, cell.boundsHigh + margin);
}

void noteFate(uint blade, uint fate)
{
    if (uvec2(FRAME.fates) != uvec2(0u))
        FRAME.fates.at[blade] = fate;
}

void main()
{
    const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    const uint thread = gl_LocalInvocationIndex;
    if (group >= push.ownerCount)
        return;
    const uint patchIndex = push.owners.at[group];
    const Patch cell = FRAME.patches.at[patchIndex];
    const Eyepoint view = FRAME.view;

    // Leave a patch that nobody sees as it is; its blades catch up when it is seen again.
    if (push.onlyUpdate == 0u && (patchCulled(view, cell) || patchHidden(view, cell))) {
        for (uint i = thread; i < cell.bladeCount; i += updateThreads)
            noteFate(cell.firstBlade + i, fatePatch);
        if (thread == 0u)
            atomicAdd(FRAME.draw.at[0].fates[fatePatch], cell.bladeCount);
        return;
    }

    // Nor is there anything to do where all of its blades are thinned out.
    const uint count = push.onlyUpdate != 0u ? cell.bladeCount : thickEnough(view, cell);
    if (count == 0u) {
        for (uint i = thread; i < cell.bladeCount; i += updateThreads)
            noteFate(cell.firstBlade + i, fateLod);
        if (thread == 0u)
            atomicAdd(FRAME.draw.at[0].fates[fateLod], cell.bladeCount);
        return;
    }

    Nature nature = FRAME.nature; // what holds references cannot be const
    nature.wind.counts = windCounts;
    nature.colliderCount = hasColliders ? nature.colliderCount : 0u;
    if (thread < fateCount)
        fateTally[thread] = 0u;
    float elapsed = max(FRAME.time - FRAME.patchTimes.at[patchIndex], 0.0f);
    const bool moves = push.onlyUpdate != 0u ||
                       movesNow(FRAME.pace, patchIndex,
                                boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), elapsed);
    elapsed = moves ? elapsed : 0.0f;
    barrier();
    const ColliderMask near = collidersNear(cell, elapsed, thread);

    for (uint i = thread; i < count; i += updateThreads) {
        const uint index = cell.firstBlade + i;
        const Blade blade = unpackBlade(FRAME.blades.at[index], cell);

        // Move it. At a standstill the stored state stays as it is, to the bit.
        BladeState state = FRAME.states.at[index];
        if (elapsed > 0.0f) {
            state = advanceBlade(blade, nature, near, state, FRAME.time, elapsed);
            FRAME.states.at[index] = state;
        }
        if (push.onlyUpdate != 0u)
            continue;

        // Judge it, and keep it if it shall be drawn.
        Verdict verdict = judgeBlade(view, blade, index, state, bladeRank(cell, i));
        if (verdict.fate == fateDrawn && (view.cullMask & cullOcclusion) != 0u &&
            isHidden(verdict.low, verdict.high))
            verdict.fate = fateOcclusion;
        const uint place = atomicAdd(fateTally[verdict.fate], 1u);
        if (verdict.fate == fateDrawn)
            survivors[place] =
                VisibleBlade(index, patchIndex, verdict.widthFactor, verdict.pixels);
        noteFate(index, verdict.fate);
    }
    for (uint i = count + thread; i < cell.bladeCount; i += updateThreads)
        noteFate(cell.firstBlade + i, fateLod);
    barrier();

    // Reserve room in the list, and report.
    const uint kept = fateTally[fateDrawn];
    if (thread == 0u) {
        if (moves) {
            FRAME.patchTimes.at[patchIndex] = FRAME.time;
            atomicAdd(FRAME.draw.at[0].simulated, count);
        }
        if (count < cell.bladeCount)
            atomicAdd(FRAME.draw.at[0].fates[fateLod], cell.bladeCount - count);
        listBase = kept > 0u ? atomicAdd(FRAME.draw.at[0].fates[fateDrawn], kept) : 0u;
        const uint filled = listBase + kept;
        atomicMax(FRAME.draw.at[0].instanceCount, (filled + drawChunk - 1u) / drawChunk);
        atomicMax(FRAME.draw.at[0].groups[0],
                  min((filled + rasterThreads - 1u) / rasterThreads, mostGroups));
    }
    if (thread != fateDrawn && thread < fateCount && fateTally[thread] > 0u)
        atomicAdd(FRAME.draw.at[0].fates[thread], fateTally[thread]);
    barrier();

    // The list has room for every blade; the guard is for a frame that was filled wrongly.
    for (uint i = thread; i < kept; i += updateThreads)
        if (listBase + i < FRAME.visibleCapacity)
            FRAME.visible.at[listBase + i] = survivors[i];
}
