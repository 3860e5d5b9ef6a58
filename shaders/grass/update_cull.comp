#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Moves the blades of the visible patches, culls each, and lists those that are to be drawn. A work-group
// takes some patches together, whose blades follow one another as if they were those of one: so all
// threads have one, and what a patch says is waited for once. Survivors gather in shared memory, so that
// some hundred cost one atomic on the list. Nothing here depends on the size of a subgroup. Where several
// views share the blades, one role of this shader moves them for all views, and another culls them for each.
#include "shaders/shared/passes.h"

layout(local_size_x = updateThreads, local_size_x_id = 2) in;
layout(push_constant, scalar) uniform Block { UpdatePush push; };
#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#define CULL_VIEW FRAME
#define WIND_SOURCE(wind, i) CULL_VIEW.environment.wind.sources[i]

// What frames may ask for, see featuresOf(); known when the pipeline is made, so that what nobody asks
// for costs nothing.
layout(constant_id = 7) const uint features = featureAll;
#define MAY_BE_PAGED ((features & featurePages) != 0u)

#include "shaders/culling/hidden.glsl"
#include "shaders/grass/survivor.glsl"
#include "shaders/grass/pages.glsl"
#include "shaders/shared/physics.h"
#include "shaders/shared/visibility.h"

/// So many survivors gather before they are listed; no fewer than a work-group has threads. More of them
/// lie together in the list, so that the rasteriser finds what it reads; but what a group shares decides
/// how many groups a processor holds at once, see decision 0031.
const uint survivorRoom = 512u;

// Known when the pipeline is made, so that winds that do not blow and colliders that are not there
// cost nothing.
layout(constant_id = 0) const uint windCounts = 0u;
layout(constant_id = 1) const bool hasColliders = false;
layout(constant_id = 3) const uint role = moveAndCull;
layout(constant_id = 4) const bool keepsBefore = false;
layout(constant_id = 5) const bool keepsEtas = false;
layout(constant_id = 6) const bool testsSmall = false; // see testedSmallPixels
layout(constant_id = 8) const uint patchesOfGroup = patchesTogether; // or 1; see own_patches.glsl

#include "shaders/grass/own_patches.glsl"
#include "shaders/grass/visibility_history.glsl"

shared uint cullResultSums[cullResultCount]; // of all patches of the group
shared uint simulatedSum;
shared uint maxFilled[2];
shared uint listBase[2];
shared uint kept[2];
// Those that frames have shown lately in front, the others from behind; see survivorOf().
shared uvec2 survivors[survivorRoom];

/// One of the patches that a work-group takes together, as its threads share it.
struct Taken {
    uint patchIndex;
    uint firstBlade;
    uint begin; ///< where its blades begin among those of all
    uint moved; ///< so many are looked at, …
    uint movedBefore;
    float elapsed; ///< [s] by which they are moved
    LeafAreaLimit limit;
    vec3 rootLow; ///< as Patch has it, from here on
    float rootStep;
    float heightLow;
    float heightStep;
    float widthLow;
    float widthStep;
    float rankLow;
    float rankHigh;
    uint bladeCount;
};
shared Taken taken[patchesTogether];
shared uint colliderBits[patchesTogether * colliderWords];

/// What of a patch its blades ask for.
Patch cellOf(uint slot)
{
    Patch cell;
    cell.firstBlade = taken[slot].firstBlade;
    cell.bladeCount = taken[slot].bladeCount;
    cell.rootLow = taken[slot].rootLow;
    cell.rootStep = taken[slot].rootStep;
    cell.heightLow = taken[slot].heightLow;
    cell.heightStep = taken[slot].heightStep;
    cell.widthLow = taken[slot].widthLow;
    cell.widthStep = taken[slot].widthStep;
    cell.rankLow = taken[slot].rankLow;
    cell.rankHigh = taken[slot].rankHigh;
    return cell;
}

/// What is drawn of a patch.
LeafAreaLimit limitOfSlot(uint slot)
{
    if ((features & featureLeafAreaLimit) == 0u)
        return noLeafAreaLimit();
    return taken[slot].limit;
}

/// Notes the colliders that may touch a blade of the patches, by all threads together.
void findColliders(uint patches, uint thread)
{
    for (uint i = thread; i < patches * CULL_VIEW.environment.colliderCount; i += gl_WorkGroupSize.x) {
        const uint slot = i / CULL_VIEW.environment.colliderCount;
        const uint number = i % CULL_VIEW.environment.colliderCount;
        const Patch cell = CULL_VIEW.patches.at[taken[slot].patchIndex];
        if (taken[slot].elapsed > 0.0f &&
            colliderNear(CULL_VIEW.environment.colliders.at[number], cell.boundsLow, cell.boundsHigh,
                         taken[slot].elapsed))
            atomicOr(colliderBits[slot * colliderWords + number / 32u], 1u << (number % 32u));
    }
}

/// The colliders that may touch a blade of a patch.
ColliderMask collidersNear(uint slot)
{
    ColliderMask near = noColliders();
    for (uint word = 0u; hasColliders && word < colliderWords; ++word)
        near.words[word] = colliderBits[slot * colliderWords + word];
    return near;
}

bool hasCullResults()
{
    return (features & featureCullResults) != 0u && uvec2(CULL_VIEW.cullResults) != uvec2(0u);
}

void noteCullResult(uint place, uint cullResult)
{
    if (hasCullResults())
        CULL_VIEW.cullResults.at[place] = cullResult;
}

/// By which blades are culled.
Eyepoint cullEyepoint()
{
    Eyepoint view = CULL_VIEW.view;
    view.cullMask &= features;
    view.lodThreshold = (features & featureThinning) != 0u ? view.lodThreshold : 0.0f;
    view.maxLeafArea = (features & featureLeafAreaLimit) != 0u ? view.maxLeafArea : 0.0f;
    return view;
}

/// Adds what the group has counted to the frame's counts: all groups do so at the same address, so
/// each does it once.
void report(uint thread)
{
    if (thread < cullResultCount && cullResultSums[thread] > 0u)
        atomicAdd(CULL_VIEW.draw.at[0].cullResults[thread], cullResultSums[thread]);
    if (thread != 0u)
        return;
    if (simulatedSum > 0u)
        atomicAdd(CULL_VIEW.draw.at[0].simulated, simulatedSum);
    for (uint list = 0u; list < 2u; ++list) {
        if (maxFilled[list] == 0u)
            continue;
        WalkLevelArray rounds = push.rounds;
        const uint round_ = list == 0u ? push.round : push.lateRound;
        atomicMax(rounds.at[round_].groups[0],
                  min((maxFilled[list] + rasterThreads - 1u) / rasterThreads, maxGroups));
        rounds.at[round_].groups[1] = 1u;
        rounds.at[round_].groups[2] = 1u;
        // Tessellated blades are all in front.
        if (list == 0u)
            atomicMax(CULL_VIEW.draw.at[0].instanceCount,
                      (maxFilled[0] + drawChunk - 1u) / drawChunk);
    }
}

/// How many of a patch's blades any of the views asks for. What one of them asks for is moved in the
/// pass of the first that sees the patch, for all of them: the others find that no time has passed.
uint wantedByAll(Patch cell, uint patchIndex, float elapsed, uint own, inout bool moves)
{
    uint wanted = own;
    for (uint i = 0u; i < push.viewCount; ++i) {
        const Eyepoint other = push.views.at[i].view;
        wanted = max(wanted, thickEnough(other, cell));
        moves = moves || movesNow(push.views.at[i].updateRate, patchIndex,
                                  boxDistance(other.eye, cell.boundsLow, cell.boundsHigh), elapsed);
    }
    moves = moves && elapsed > 0.0f;
    return wanted;
}

/// A survivor as it is listed, while its patch is taken.
VisibleBlade listed(uvec2 survivor)
{
    const uint slot = slotOfSurvivor(survivor);
    return listedOf(survivor, taken[slot].firstBlade, taken[slot].patchIndex, limitOfSlot(slot).height);
}

/// Lists the survivors that have gathered, and counts them. All threads come here together.
void listSurvivors(uint thread)
{
    if (thread == 0u)
        cullResultSums[cullResultDrawn] += kept[0] + kept[1];
    if (thread < 2u && kept[thread] > 0u) {
        WalkLevelArray rounds = push.rounds;
        listBase[thread] =
            atomicAdd(rounds.at[thread == 0u ? push.round : push.lateRound].count, kept[thread]);
        maxFilled[thread] = max(maxFilled[thread], listBase[thread] + kept[thread]);
    }
    barrier();
    // The list has room for every blade of a round; the guard is for a frame that was filled wrongly.
    for (uint i = thread; i < kept[0]; i += gl_WorkGroupSize.x)
        if (listBase[0] + i < CULL_VIEW.visibleCapacity)
            CULL_VIEW.visible.at[listBase[0] + i] = listed(survivors[i]);
    for (uint i = thread; i < kept[1]; i += gl_WorkGroupSize.x)
        if (listBase[1] + i < CULL_VIEW.visibleCapacity)
            CULL_VIEW.visible.at[CULL_VIEW.visibleCapacity - 1u - listBase[1] - i] =
                listed(survivors[survivorRoom - 1u - i]);
    barrier();
    if (thread < 2u)
        kept[thread] = 0u;
    barrier();
}

/// A blade as it lies in memory, with what has become of it so far.
struct StoredBlade {
    uint place;
    PackedBlade bits;
    BladeState state;
};

StoredBlade storedBlade(uint index)
{
    const uint place = placeOf(uvec2(CULL_VIEW.pages), index);
    return StoredBlade(place, CULL_VIEW.blades.at[place],
                       BladeState(CULL_VIEW.states.at[place], keepsEtas ? CULL_VIEW.etas.at[place] : 0.0));
}

/// Takes a patch, of which `live` says how many blades the view asks for. One thread does so, which is the
/// only one that asks when the patch was moved.
void takePatch(Eyepoint view, VisiblePatch live, uint slot)
{
    const Patch cell = CULL_VIEW.patches.at[live.patchIndex];
    const bool isAll = push.onlyUpdate != 0u;
    const uint count = !isAll ? live.count : isPresent(uvec2(CULL_VIEW.pages), cell) ? cell.bladeCount : 0u;
    float elapsed = max(CULL_VIEW.time - CULL_VIEW.patchTimes.at[live.patchIndex], 0.0f);
    bool moves = role != onlyCull &&
                 (isAll ? count > 0u
                        : movesNow(CULL_VIEW.updateRate, live.patchIndex,
                                   boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), elapsed));
    const uint moved =
        role == onlyMove && !isAll ? wantedByAll(cell, live.patchIndex, elapsed, count, moves) : count;
    elapsed = moves ? elapsed : 0.0f;
    const uint movedBefore = CULL_VIEW.patchCounts.at[live.patchIndex];
    if (moves) {
        CULL_VIEW.patchTimes.at[live.patchIndex] = CULL_VIEW.time;
        atomicAdd(simulatedSum, moved);
    }
    if (role != onlyCull && (moves || moved > movedBefore))
        CULL_VIEW.patchCounts.at[live.patchIndex] = moved;
    if (!isAll)
        atomicAdd(cullResultSums[cullResultLod], cell.bladeCount - count);
    taken[slot] = Taken(live.patchIndex, cell.firstBlade, 0u, moved, movedBefore, elapsed,
                        leafAreaLimitOf(view, cell), cell.rootLow, cell.rootStep, cell.heightLow, cell.heightStep,
                        cell.widthLow, cell.widthStep, cell.rankLow, cell.rankHigh, cell.bladeCount);
}

/// Notes of the blades of a patch that are not looked at, for those who ask, that they are thinned out.
void noteThinned(uint slot, uint thread)
{
    if (!hasCullResults() || role == onlyMove)
        return;
    for (uint i = taken[slot].moved + thread; i < taken[slot].bladeCount; i += gl_WorkGroupSize.x)
        noteCullResult(placeOf(uvec2(CULL_VIEW.pages), taken[slot].firstBlade + i), cullResultLod);
}

/// Moves and culls blade `i` of a patch.
void updateBlade(Eyepoint view, Environment environment, uint slot, uint i, StoredBlade stored)
{
    const uint movedBefore = taken[slot].movedBefore;
    const float since =
        role == onlyCull ? 0.0f : i < movedBefore ? taken[slot].elapsed : settlingTime;
    if (role == onlyMove && since <= 0.0f)
        return;
    const Patch cell = cellOf(slot);
    const Blade blade = unpackBlade(stored.bits, cell);
    const uint index = cell.firstBlade + i;

    // Move it. At a standstill the stored state stays as it is, to the bit.
    BladeState state = stored.state;
    if (since > 0.0f) {
        const uint before = state.turn;
        state = advanceBlade(blade, environment, collidersNear(slot), state, CULL_VIEW.time, since);
        // One that was thinned out comes back from nowhere.
        if (keepsBefore) {
            UintArray kept = push.before;
            kept.at[index] = i < movedBefore ? before : state.turn;
        }
        CULL_VIEW.states.at[stored.place] = state.turn;
        if (keepsEtas)
            CULL_VIEW.etas.at[stored.place] = state.eta;
    }
    if (role == onlyMove || push.onlyUpdate != 0u)
        return;

    // Cull it, and keep it if it shall be drawn. The late pass finds out of large blades whether anything
    // hides them; of others it is found here whether the ground does.
    const LeafAreaLimit limit = limitOfSlot(slot);
    const Blade drawn = raised(blade, limit.height);
    Verdict verdict = cullBlade(view, limit, drawn, index, state, bladeRank(cell, i));
    const float pixels = pixelsCovered(drawn, verdict.pixels, verdict.widthFactor);
    const bool isTestedLater = hasTwoPasses() && isTested(pixels);
    if (verdict.cullResult == cullResultDrawn && (view.cullMask & cullOcclusion) != 0u && !isTestedLater &&
        isHidden(drawn.root, verdict.v1, verdict.v2, verdict.margin))
        verdict.cullResult = cullResultOcclusion;
    if (verdict.cullResult != cullResultDrawn) {
        atomicAdd(cullResultSums[verdict.cullResult], 1u);
    } else {
        const uint seen = takeSeen(index, isTestedLater);
        const uint list = seen != 0u ? 0u : 1u;
        const uint place = atomicAdd(kept[list], 1u);
        survivors[list == 0u ? place : survivorRoom - 1u - place] =
            survivorOf(slot, i, verdict.widthFactor, list == 0u ? allQuarters & ~seen : 0u, verdict.pixels);
    }
    noteCullResult(stored.place, verdict.cullResult);
}

/// The patch to which blade `i` of all belongs, from `slot` on.
uint slotOf(uint i, uint slot, uint patches)
{
    while (slot + 1u < patches && i >= taken[slot + 1u].begin)
        ++slot;
    return slot;
}

/// Moves, culls and lists all blades of the patches.
void updatePatches(Eyepoint view, Environment environment, uint patches)
{
    // No less than the survivors that have not been listed yet.
    uint gathered = 0u;
    const uint thread = gl_LocalInvocationIndex;
    const uint end = taken[patches - 1u].begin + taken[patches - 1u].moved;
    uint slot = slotOf(thread, 0u, patches);
    // The next blade is read while one is moved.
    StoredBlade next;
    if (thread < end)
        next = storedBlade(taken[slot].firstBlade + (thread - taken[slot].begin));
    for (uint first = 0u; first < end; first += gl_WorkGroupSize.x) {
        if (role != onlyMove && push.onlyUpdate == 0u) {
            if (gathered + gl_WorkGroupSize.x > survivorRoom) {
                barrier();
                gathered = kept[0] + kept[1];
                barrier();
                if (gathered + gl_WorkGroupSize.x > survivorRoom) {
                    listSurvivors(thread);
                    gathered = 0u;
                }
            }
            gathered += gl_WorkGroupSize.x;
        }
        const uint i = first + thread;
        const uint own = slot;
        const StoredBlade stored = next;
        if (i + gl_WorkGroupSize.x < end) {
            const uint after = i + gl_WorkGroupSize.x;
            slot = slotOf(after, slot, patches);
            next = storedBlade(taken[slot].firstBlade + (after - taken[slot].begin));
        }
        if (i < end)
            updateBlade(view, environment, own, i - taken[own].begin, stored);
    }
    // What is kept of survivors means nothing beside other patches.
    if (role != onlyMove && push.onlyUpdate == 0u) {
        barrier();
        listSurvivors(thread);
    }
}

void main()
{
    const Eyepoint view = cullEyepoint();
    Environment environment = CULL_VIEW.environment; // what holds references cannot be const
    environment.wind.counts = windCounts;
    environment.colliderCount = hasColliders ? environment.colliderCount : 0u;
    const uint thread = gl_LocalInvocationIndex;
    if (thread < cullResultCount)
        cullResultSums[thread] = 0u;
    if (thread == 0u) {
        simulatedSum = 0u;
        maxFilled[0] = 0u;
        maxFilled[1] = 0u;
        kept[0] = 0u;
        kept[1] = 0u;
    }
    const bool isAll = push.onlyUpdate != 0u;
    const uint begin = isAll ? 0u : push.firstLive;
    // Those that a work-group takes follow in steps.
    const uint step_ = areMany() ? 1u : gl_NumWorkGroups.x;
    const uint end = isAll ? push.nonEmptyPatchCount
                           : min(push.levels.at[liveLevel].count, push.firstLive + push.maxLive);
    for (uint turn = 0u; begin + firstOfIteration(turn) < end; ++turn) {
        const uint first = begin + firstOfIteration(turn);
        uint patches = 1u;
        while (patches < patchesTogether && first + step_ * patches < end)
            ++patches;
        // Nobody looks at the patches before any more.
        barrier();
        if (thread < patches)
            takePatch(view, liveAt(first + step_ * thread), thread);
        for (uint i = thread; hasColliders && i < patches * colliderWords; i += gl_WorkGroupSize.x)
            colliderBits[i] = 0u;
        barrier();
        for (uint slot = thread; slot < patches; slot += gl_WorkGroupSize.x) {
            uint before = 0u;
            for (uint other = 0u; other < slot; ++other)
                before += taken[other].moved;
            taken[slot].begin = before;
        }
        if (hasColliders)
            findColliders(patches, thread);
        barrier();
        updatePatches(view, environment, patches);
        for (uint slot = 0u; slot < patches; ++slot)
            noteThinned(slot, thread);
    }
    barrier();
    report(thread);
}
