#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Moves the blades of the live patches, judges each, and lists those that are to be drawn. One
// work-group per patch at a time; survivors gather in shared memory, so that some patches together
// cost one atomic on the list. Nothing here depends on the size of a subgroup. Where several views share the blades,
// one role of this shader moves them for all views, and another judges them for each.
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"

layout(local_size_x = updateThreads, local_size_x_id = 2) in;
layout(push_constant, scalar) uniform Block { UpdatePush push; };
#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#define JUDGED FRAME

#include "shaders/culling/hidden.glsl"
#include "shaders/grass/pages.glsl"

// Known when the pipeline is made, so that winds that do not blow and colliders that are not there
// cost nothing.
layout(constant_id = 0) const uint windCounts = 0u;
layout(constant_id = 1) const bool hasColliders = false;
layout(constant_id = 3) const uint role = moveAndJudge;
layout(constant_id = 4) const bool keepsBefore = false;
layout(constant_id = 5) const bool keepsEtas = false;
layout(constant_id = 6) const bool asksSmall = false; // see askedSmallPixels

shared uint fateSums[fateCount]; // of all patches of the group
shared uint simulatedSum;
shared uint mostFilled[2];
shared uint listBase[2];
shared uint kept[2];
// Of one patch or several small ones: those that the frame before has shown in front, the others from behind.
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
    for (uint i = thread; i < JUDGED.nature.colliderCount; i += gl_WorkGroupSize.x)
        if (colliderNear(JUDGED.nature.colliders.at[i], cell.boundsLow, cell.boundsHigh, elapsed))
            atomicOr(colliderBits[i / 32u], 1u << (i % 32u));
    barrier();
    for (uint word = 0u; word < colliderWords; ++word)
        near.words[word] = colliderBits[word];
    return near;
}

void noteFate(uint place, uint fate)
{
    if (uvec2(JUDGED.fates) != uvec2(0u))
        JUDGED.fates.at[place] = fate;
}

/// Adds what the group has counted to the frame's counts: all groups do so at the same address, so
/// each does it once.
void report(uint thread)
{
    if (thread < fateCount && fateSums[thread] > 0u)
        atomicAdd(JUDGED.draw.at[0].fates[thread], fateSums[thread]);
    if (thread != 0u)
        return;
    if (simulatedSum > 0u)
        atomicAdd(JUDGED.draw.at[0].simulated, simulatedSum);
    for (uint list = 0u; list < 2u; ++list) {
        if (mostFilled[list] == 0u)
            continue;
        WalkLevelArray rounds = push.rounds;
        const uint round_ = list == 0u ? push.round : push.lateRound;
        atomicMax(rounds.at[round_].groups[0],
                  min((mostFilled[list] + rasterThreads - 1u) / rasterThreads, mostGroups));
        rounds.at[round_].groups[1] = 1u;
        rounds.at[round_].groups[2] = 1u;
        // Tessellated blades are all in front.
        if (list == 0u)
            atomicMax(JUDGED.draw.at[0].instanceCount,
                      (mostFilled[0] + drawChunk - 1u) / drawChunk);
    }
}

/// Whether it is asked for a blade of so many pixels if others hide it.
bool isAsked(float pixels)
{
    return pixels > (asksSmall ? askedSmallPixels : askedPixels);
}

/// Which halves of a blade that covers so many pixels the frame before has shown, as RasterPush::seen has
/// them; from now on it has not. One of which nobody asks counts as shown.
uint takeSeen(uint index, float pixels)
{
    if (uvec2(push.seenBefore) == uvec2(0u) || !isAsked(pixels))
        return 3u;
    UintArray words = push.seenBefore;
    const uint shift = 2u * (index % 16u);
    const uint seen = (words.at[index / 16u] >> shift) & 3u;
    if (seen != 0u)
        atomicAnd(words.at[index / 16u], ~(3u << shift));
    return seen;
}

/// How many of a patch's blades any of the views asks for. What one of them asks for is moved in the
/// pass of the first that sees the patch, for all of them: the others find that no time has passed.
uint wantedByAll(Patch cell, uint patchIndex, float elapsed, uint own, inout bool moves)
{
    uint wanted = own;
    for (uint i = 0u; i < push.viewCount; ++i) {
        const Eyepoint other = push.views.at[i].view;
        wanted = max(wanted, thickEnough(other, cell));
        moves = moves || movesNow(push.views.at[i].pace, patchIndex,
                                  boxDistance(other.eye, cell.boundsLow, cell.boundsHigh), elapsed);
    }
    moves = moves && elapsed > 0.0f;
    return wanted;
}

/// Lists the survivors that have gathered, and counts them. All threads come here together.
void listSurvivors(uint thread)
{
    if (thread == 0u)
        fateSums[fateDrawn] += kept[0] + kept[1];
    if (thread < 2u && kept[thread] > 0u) {
        WalkLevelArray rounds = push.rounds;
        listBase[thread] =
            atomicAdd(rounds.at[thread == 0u ? push.round : push.lateRound].count, kept[thread]);
        mostFilled[thread] = max(mostFilled[thread], listBase[thread] + kept[thread]);
    }
    barrier();
    // The list has room for every blade of a round; the guard is for a frame that was filled wrongly.
    for (uint i = thread; i < kept[0]; i += gl_WorkGroupSize.x)
        if (listBase[0] + i < JUDGED.visibleCapacity)
            JUDGED.visible.at[listBase[0] + i] = survivors[i];
    for (uint i = thread; i < kept[1]; i += gl_WorkGroupSize.x)
        if (listBase[1] + i < JUDGED.visibleCapacity)
            JUDGED.visible.at[JUDGED.visibleCapacity - 1u - listBase[1] - i] =
                survivors[maxPatchBlades - 1u - i];
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
    const uint place = placeOf(uvec2(JUDGED.pages), index);
    return StoredBlade(place, JUDGED.blades.at[place],
                       BladeState(JUDGED.states.at[place], keepsEtas ? JUDGED.etas.at[place] : 0.0));
}

/// Moves and judges the first `count` blades of a patch; the others are thinned out. `gathered` is
/// no less than the survivors that have not been listed yet.
void updatePatch(Eyepoint view, Nature nature, uint patchIndex, uint count, inout uint gathered)
{
    const uint thread = gl_LocalInvocationIndex;
    const Patch cell = JUDGED.patches.at[patchIndex];
    float elapsed = max(JUDGED.time - JUDGED.patchTimes.at[patchIndex], 0.0f);
    bool moves = role != onlyJudge &&
                 (push.onlyUpdate != 0u ||
                  movesNow(JUDGED.pace, patchIndex,
                           boxDistance(view.eye, cell.boundsLow, cell.boundsHigh), elapsed));
    const uint moved = role == onlyMove ? wantedByAll(cell, patchIndex, elapsed, count, moves) : count;
    elapsed = moves ? elapsed : 0.0f;
    const uint movedBefore = JUDGED.patchCounts.at[patchIndex];

    // Beyond this all survivors of the patches before have gathered, and all threads have read when
    // this one was moved.
    barrier();
    gathered += role == onlyMove ? 0u : count;
    if (gathered > maxPatchBlades) {
        listSurvivors(thread);
        gathered = count;
    }
    if (thread == 0u) {
        if (moves) {
            JUDGED.patchTimes.at[patchIndex] = JUDGED.time;
            simulatedSum += moved;
        }
        if (role != onlyJudge && (moves || moved > movedBefore))
            JUDGED.patchCounts.at[patchIndex] = moved;
        atomicAdd(fateSums[fateLod], cell.bladeCount - count);
    }
    const Layers layers = layersOf(view, cell);
    const ColliderMask near = collidersNear(cell, elapsed, thread);

    // The next blade is read while one is moved.
    StoredBlade next;
    if (thread < moved)
        next = storedBlade(cell.firstBlade + thread);
    for (uint i = thread; i < moved; i += gl_WorkGroupSize.x) {
        const uint index = cell.firstBlade + i;
        const StoredBlade stored = next;
        if (i + gl_WorkGroupSize.x < moved)
            next = storedBlade(index + gl_WorkGroupSize.x);
        const float since = role == onlyJudge ? 0.0f : i < movedBefore ? elapsed : settlingTime;
        if (role == onlyMove && since <= 0.0f)
            continue;
        const Blade blade = unpackBlade(stored.bits, cell);

        // Move it. At a standstill the stored state stays as it is, to the bit.
        BladeState state = stored.state;
        if (since > 0.0f) {
            const uint before = state.turn;
            state = advanceBlade(blade, nature, near, state, JUDGED.time, since);
            // One that was thinned out comes back from nowhere.
            if (keepsBefore) {
                UintArray kept = push.before;
                kept.at[index] = i < movedBefore ? before : state.turn;
            }
            JUDGED.states.at[stored.place] = state.turn;
            if (keepsEtas)
                JUDGED.etas.at[stored.place] = state.eta;
        }
        if (role == onlyMove || push.onlyUpdate != 0u)
            continue;

        // Judge it, and keep it if it shall be drawn.
        const Blade drawn = raised(blade, layers.rise);
        Verdict verdict = judgeBlade(view, layers, drawn, index, state, bladeRank(cell, i));
        if (verdict.fate == fateDrawn && (view.cullMask & cullOcclusion) != 0u &&
            isHidden(verdict.low, verdict.high))
            verdict.fate = fateOcclusion;
        if (verdict.fate != fateDrawn) {
            atomicAdd(fateSums[verdict.fate], 1u);
        } else {
            const float pixels = pixelsCovered(drawn, verdict.pixels, verdict.widthFactor);
            const uint seen = takeSeen(index, pixels);
            const uint list = seen != 0u ? 0u : 1u;
            const uint late = seen == 1u ? upperHalfIsLate : seen == 2u ? lowerHalfIsLate : 0u;
            const uint slot = atomicAdd(kept[list], 1u);
            survivors[list == 0u ? slot : maxPatchBlades - 1u - slot] =
                VisibleBlade(index, patchIndex, packFactors(verdict.widthFactor, layers.rise) | late,
                             verdict.pixels);
        }
        noteFate(stored.place, verdict.fate);
    }
    for (uint i = count + thread; role != onlyMove && i < cell.bladeCount; i += gl_WorkGroupSize.x)
        noteFate(placeOf(uvec2(JUDGED.pages), cell.firstBlade + i), fateLod);
}

/// What is done as item `i` of `end`: a live patch, or, of all, an owner, with whatever count.
LivePatch patchAt(uint i, uint end, bool all)
{
    LivePatch live = LivePatch(0u, 0u);
    if (i < end && all)
        live.patchIndex = push.owners.at[i];
    else if (i < end)
        live = push.live.at[i];
    return live;
}

void main()
{
    const Eyepoint view = JUDGED.view;
    Nature nature = JUDGED.nature; // what holds references cannot be const
    nature.wind.counts = windCounts;
    nature.colliderCount = hasColliders ? nature.colliderCount : 0u;
    const uint thread = gl_LocalInvocationIndex;
    if (thread < fateCount)
        fateSums[thread] = 0u;
    if (thread == 0u) {
        simulatedSum = 0u;
        mostFilled[0] = 0u;
        mostFilled[1] = 0u;
        kept[0] = 0u;
        kept[1] = 0u;
    }
    uint gathered = 0u;
    const bool all = push.onlyUpdate != 0u;
    const uint first = all ? 0u : push.firstLive;
    const uint end =
        all ? push.ownerCount
            : min(push.levels.at[liveLevel].count, push.firstLive + push.mostLive);
    // One loop: a driver that cannot jump over what it need not do would do the work of two. The next
    // patch's index is read while this one's blades are moved.
    uint i = first + gl_WorkGroupID.x;
    LivePatch next = patchAt(i, end, all);
    while (i < end) {
        const LivePatch live = next;
        i += gl_NumWorkGroups.x;
        next = patchAt(i, end, all);
        uint count = live.count;
        if (all) {
            const Patch cell = JUDGED.patches.at[live.patchIndex];
            if (!isPresent(uvec2(JUDGED.pages), cell))
                continue;
            count = cell.bladeCount;
        }
        updatePatch(view, nature, live.patchIndex, count, gathered);
    }
    barrier();
    listSurvivors(thread);
    report(thread);
}
