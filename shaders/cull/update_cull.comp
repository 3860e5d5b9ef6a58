#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Moves the blades of the visible patches, culls each, and lists the drawn ones. A work-group takes several patches
// together and numbers their blades consecutively: all threads have a blade, and patch data cost one wait. Survivors
// gather in shared memory, so that hundreds of them cost one atomic on the list. The code does not depend on the
// subgroup size. If several views share the blades, one role of this shader moves them for all views, and another role
// culls them for each view.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(local_size_x = updateThreads, local_size_x_id = idThreadsOfGroup) in;
layout(push_constant, scalar) uniform Block { UpdatePush push; };
#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#define CULL_VIEW FRAME
#define WIND_SOURCE(wind, i) CULL_VIEW.environment.wind.sources[i]
#define WIND_PHASE(wind, i) CULL_VIEW.environment.wind.phases[i]
#define WIND_LATTICE(wind) CULL_VIEW.environment.wind.lattice

// Features that frames may use, see featuresOf(). Known at pipeline creation, so that unused features cost nothing.
layout(constant_id = idFeatures) const uint features = featureAll;
#define MAY_BE_PAGED ((features & featurePages) != 0u)

#include "shaders/cull/hidden.glsl"
#include "shaders/cull/survivor.glsl"
#include "shaders/blade/pages.glsl"
#include "shaders/shared/physics.h"
#include "shaders/shared/visibility.h"

/// Number of survivors that gather before they are listed; at least the threads of a work-group. More survivors lie
/// closer together in the list, which speeds up the rasteriser's reads. But the size of shared memory limits the number
/// of resident groups per processor, see decision 0031.
const uint survivorRoom = 512u;

// Known at pipeline creation, so that absent winds and colliders cost nothing.
layout(constant_id = idWindCounts) const uint windCounts = 0u;
layout(constant_id = idHasColliders) const bool hasColliders = false;
layout(constant_id = idRole) const uint role = moveAndCull;
layout(constant_id = idKeepsBefore) const bool keepsBefore = false;
layout(constant_id = idKeepsEtas) const bool keepsEtas = false;
layout(constant_id = idTestsSmall) const bool testsSmall = false; // see testedSmallPixels
layout(constant_id = idPatchesOfGroup) const uint patchesOfGroup = patchesTogether; // or 1; see own_patches.glsl
layout(constant_id = idTakes) const uint takes = takesAll;

#include "shaders/cull/own_patches.glsl"
#include "shaders/cull/visibility_history.glsl"

// Over all patches of the group. One longer than needed: an array of the type of DrawArguments::cullResults would get its
// layout, which SPIR-V does not allow in shared memory.
shared uint cullResultSums[cullResultCount + 1u];
shared uint simulatedSum;
shared uint maxFilled[2];
shared uint listBase[2];
shared uint kept[2];
// Survivors in the visibility history from the front, others from the back; see survivorOf().
shared uvec2 survivors[survivorRoom];

/// One of the patches that a work-group takes together, in shared memory.
struct OwnPatch {
    uint patchIndex;
    uint firstBlade;
    uint begin; ///< index of its first blade among the blades of all slots
    uint moved; ///< number of its blades that are processed
    uint movedBefore;
    float elapsed; ///< [s] since the last update; 0 if it is not moved
    LeafAreaLimit limit;
    vec3 rootLow; ///< from here on as in Patch
    float rootStep;
    float heightLow;
    float heightStep;
    float widthLow;
    float widthStep;
    float rankLow;
    float rankHigh;
    uint bladeCount;
};
shared OwnPatch ownPatches[patchesTogether];
shared uint colliderBits[patchesTogether * colliderWords];

/// The part of a patch that its blades need.
Patch cellOf(uint slot)
{
    Patch cell;
    cell.firstBlade = ownPatches[slot].firstBlade;
    cell.bladeCount = ownPatches[slot].bladeCount;
    cell.rootLow = ownPatches[slot].rootLow;
    cell.rootStep = ownPatches[slot].rootStep;
    cell.heightLow = ownPatches[slot].heightLow;
    cell.heightStep = ownPatches[slot].heightStep;
    cell.widthLow = ownPatches[slot].widthLow;
    cell.widthStep = ownPatches[slot].widthStep;
    cell.rankLow = ownPatches[slot].rankLow;
    cell.rankHigh = ownPatches[slot].rankHigh;
    return cell;
}

/// The leaf-area limit of a patch.
LeafAreaLimit limitOfSlot(uint slot)
{
    if ((features & featureLeafAreaLimit) == 0u)
        return noLeafAreaLimit();
    return ownPatches[slot].limit;
}

#include "shaders/cull/near_colliders.glsl"

bool hasCullResults()
{
    return (features & featureCullResults) != 0u && uvec2(CULL_VIEW.cullResults) != uvec2(0u);
}

void noteCullResult(uint place, uint cullResult)
{
    if (hasCullResults())
        CULL_VIEW.cullResults.at[place] = cullResult;
}

/// The eyepoint for culling, limited to the enabled features.
Eyepoint cullEyepoint()
{
    Eyepoint view = CULL_VIEW.view;
    view.cullMask &= features;
    view.lodThreshold = (features & featureThinning) != 0u ? view.lodThreshold : 0.0f;
    view.maxLeafArea = (features & featureLeafAreaLimit) != 0u ? view.maxLeafArea : 0.0f;
    return view;
}

/// Adds the group's counts to the frame's counts. Each group does so once, because all groups add at the same address.
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
        atomicMax(CULL_VIEW.draw.at[list].instanceCount, (maxFilled[list] + drawChunk - 1u) / drawChunk);
    }
}

/// The largest number of a patch's blades that any view wants. The pass of the first view that sees the patch moves
/// them for all views; later passes find that no time has elapsed.
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

/// A survivor as it is listed; valid while its slot holds that patch.
VisibleBlade listed(uvec2 survivor)
{
    const uint slot = slotOfSurvivor(survivor);
    return listedOf(survivor, ownPatches[slot].firstBlade, ownPatches[slot].patchIndex, limitOfSlot(slot).height);
}

/// Lists and counts the gathered survivors. All threads call this together.
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
    // The list has room for every blade of a round; the test guards against a wrongly filled frame.
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

/// A blade in memory, with its current state.
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

/// Loads the patch at a place of the list into a slot; the list has the number of blades that the view wants. Only one thread calls
/// this and reads the time of the patch's last update.
void loadPatch(Eyepoint view, uint place, uint slot)
{
    const VisiblePatch visible = visiblePatchAt(place);
    const Patch cell = CULL_VIEW.patches.at[visible.patchIndex];
    const bool isAll = push.onlyUpdate != 0u;
    const uint count = !isAll ? visible.count : isPresent(uvec2(CULL_VIEW.pages), cell) ? cell.bladeCount : 0u;
    float elapsed = secondsBetween(CULL_VIEW.patchTimes.at[visible.patchIndex], CULL_VIEW.tick);
    bool moves = role != onlyCull &&
                 (isAll ? count > 0u
                        : movesNow(CULL_VIEW.updateRate, visible.patchIndex,
                                   boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), elapsed));
    const uint moved =
        role == onlyMove && !isAll ? wantedByAll(cell, visible.patchIndex, elapsed, count, moves) : count;
    elapsed = moves ? elapsed : 0.0f;
    if (takes == takesFar && isNearCollider(cell, elapsed)) {
        leaveToNear(place);
        ownPatches[slot].moved = 0u;
        ownPatches[slot].bladeCount = 0u;
        return;
    }
    const uint movedBefore = CULL_VIEW.patchCounts.at[visible.patchIndex];
    if (moves) {
        CULL_VIEW.patchTimes.at[visible.patchIndex] = CULL_VIEW.tick;
        atomicAdd(simulatedSum, moved);
    }
    if (role != onlyCull && (moves || moved > movedBefore))
        CULL_VIEW.patchCounts.at[visible.patchIndex] = moved;
    if (!isAll)
        atomicAdd(cullResultSums[cullResultLod], cell.bladeCount - count);
    ownPatches[slot] = OwnPatch(visible.patchIndex, cell.firstBlade, 0u, moved, movedBefore, elapsed,
                        leafAreaLimitOf(view, cell), cell.rootLow, cell.rootStep, cell.heightLow, cell.heightStep,
                        cell.widthLow, cell.widthStep, cell.rankLow, cell.rankHigh, cell.bladeCount);
}

/// Writes the cull result "thinned out" for the blades of a patch that are not processed, if cull results are on.
void noteThinned(uint slot, uint thread)
{
    if (!hasCullResults() || role == onlyMove)
        return;
    for (uint i = ownPatches[slot].moved + thread; i < ownPatches[slot].bladeCount; i += gl_WorkGroupSize.x)
        noteCullResult(placeOf(uvec2(CULL_VIEW.pages), ownPatches[slot].firstBlade + i), cullResultLod);
}

/// Moves and culls blade `i` of a patch.
void updateBlade(Eyepoint view, Environment environment, uint slot, uint i, StoredBlade stored)
{
    const uint movedBefore = ownPatches[slot].movedBefore;
    const bool hasState = i < movedBefore && stored.state.turn != unsettledTurn;
    const float since = role == onlyCull ? 0.0f : hasState ? ownPatches[slot].elapsed : settlingTime;
    if (role == onlyMove && since <= 0.0f)
        return;
    const Patch cell = cellOf(slot);
    const Blade blade = unpackBlade(stored.bits, cell);
    const uint index = cell.firstBlade + i;

    // Move it. At a standstill the stored state stays as it is, to the bit.
    BladeState state = stored.state;
    if (since > 0.0f) {
        state.turn = state.turn == unsettledTurn ? 0u : state.turn;
        const uint before = state.turn;
        state = advanceBlade(blade, environment, collidersNear(slot), state, 0.0, since);
        // A blade that was thinned out before, or is new, has no earlier state and gets no motion.
        if (keepsBefore) {
            UintArray kept = push.before;
            kept.at[stored.place] = hasState ? before : state.turn;
        }
        CULL_VIEW.states.at[stored.place] = state.turn;
        if (keepsEtas)
            CULL_VIEW.etas.at[stored.place] = state.eta;
    }
    if (role == onlyMove || push.onlyUpdate != 0u)
        return;

    // Cull it, and keep it if it is drawn. The late pass tests large blades for occlusion; this pass tests the others
    // against the ground.
    const LeafAreaLimit limit = limitOfSlot(slot);
    uint number = 0u;
    PosedBlade drawn = posedBlade(raised(blade, limit.height), state);
    if ((features & featureOrgans) != 0u) {
        const Species species = CULL_VIEW.species.at[blade.species];
        number = ribbonNumber(species, blade);
        if (number > 0u)
            drawn = ribbonOf(CULL_VIEW.organs, species, drawn, number);
    }
    // A plant is thinned out as a whole.
    Verdict verdict = cullBlade(view, limit, drawn, bladeRank(cell, i - min(number, i)));
    const float pixels = pixelsCovered(drawn.blade, verdict.pixels, verdict.widthFactor);
    const bool isTestedLater = hasTwoPasses() && isTested(pixels);
    if (verdict.cullResult == cullResultDrawn && (view.cullMask & cullOcclusion) != 0u && !isTestedLater &&
        isHidden(drawn.v0, drawn.v1, drawn.v2, verdict.margin))
        verdict.cullResult = cullResultOcclusion;
    if (verdict.cullResult != cullResultDrawn) {
        atomicAdd(cullResultSums[verdict.cullResult], 1u);
    } else {
        const uint seen = takeHistory(index, isTestedLater);
        const uint list = seen != 0u ? 0u : 1u;
        const uint place = atomicAdd(kept[list], 1u);
        survivors[list == 0u ? place : survivorRoom - 1u - place] =
            survivorOf(slot, i, verdict.widthFactor, list == 0u ? allQuarters & ~seen : 0u, verdict.pixels);
    }
    noteCullResult(stored.place, verdict.cullResult);
}

/// The slot of the patch that contains blade `i` of all slots, searched from `slot` on.
uint slotOf(uint i, uint slot, uint patches)
{
    while (slot + 1u < patches && i >= ownPatches[slot + 1u].begin)
        ++slot;
    return slot;
}

/// Moves, culls and lists all blades of the patches.
void updatePatches(Eyepoint view, Environment environment, uint patches)
{
    // Upper bound of the survivors that are not listed yet.
    uint gathered = 0u;
    const uint thread = gl_LocalInvocationIndex;
    const uint end = ownPatches[patches - 1u].begin + ownPatches[patches - 1u].moved;
    uint slot = slotOf(thread, 0u, patches);
    // Read the next blade while the current one is moved.
    StoredBlade next;
    if (thread < end)
        next = storedBlade(ownPatches[slot].firstBlade + (thread - ownPatches[slot].begin));
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
            next = storedBlade(ownPatches[slot].firstBlade + (after - ownPatches[slot].begin));
        }
        if (i < end)
            updateBlade(view, environment, own, i - ownPatches[own].begin, stored);
    }
    // Survivors refer to slots, so they are listed before the slots get the next patches.
    if (role != onlyMove && push.onlyUpdate == 0u) {
        barrier();
        listSurvivors(thread);
    }
}

void main()
{
    const Eyepoint view = cullEyepoint();
    Environment environment = CULL_VIEW.environment; // a struct with references cannot be const
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
    const uint begin = isAll || takes == takesNear ? 0u : push.firstPatch;
    // Step between the patches of a work-group.
    const uint step_ = areMany() ? 1u : gl_NumWorkGroups.x;
    const uint end = takes == takesNear ? push.nearCount.at[0].count
                     : isAll            ? push.nonEmptyPatchCount
                                        : min(push.levels.at[visibleLevel].count, push.firstPatch + push.maxPatches);
    for (uint turn = 0u; begin + firstOfIteration(turn) < end; ++turn) {
        const uint first = begin + firstOfIteration(turn);
        uint patches = 1u;
        while (patches < patchesTogether && first + step_ * patches < end)
            ++patches;
        // All threads have finished with the previous patches.
        barrier();
        if (thread < patches)
            loadPatch(view, placeOfPatch(first + step_ * thread), thread);
        for (uint i = thread; hasColliders && i < patches * colliderWords; i += gl_WorkGroupSize.x)
            colliderBits[i] = 0u;
        barrier();
        for (uint slot = thread; slot < patches; slot += gl_WorkGroupSize.x) {
            uint before = 0u;
            for (uint other = 0u; other < slot; ++other)
                before += ownPatches[other].moved;
            ownPatches[slot].begin = before;
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
