#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Tests the nodes of one level of the patch tree. Subtrees of culled nodes are skipped and their blades counted.
// Children of the other nodes go to the next level, and non-empty patches to the list of visible patches.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"

layout(local_size_x = walkThreads) in;
layout(push_constant, scalar) uniform Block { WalkPush push; };
#define CULL_VIEW push.cullView.at[0]

// Number of visible patches per work-group of the update; known at pipeline creation.
layout(constant_id = idPatchesOfGroup) const uint patchesOfGroup = patchesTogether;

#include "shaders/cull/hidden.glsl"
#include "shaders/blade/pages.glsl"

shared uint childTotal;
shared uint visibleTotal;
shared uint childBase;
shared uint visibleBase;
shared uint unseenTotal;
shared uint thinnedTotal;

/// The decision for a node.
struct Step {
    uint children; ///< number of children to test next
    uint wanted;     ///< number of its first blades to move and cull …
    bool isVisible;   ///< … if any
    uint unseen;   ///< blades skipped here because their patch is culled …
    uint thinned;  ///< … or because they have no width
};

/// Whether the ground hides the whole node.
bool nodeHidden(Eyepoint view, Patch cell, float widest)
{
    if ((view.cullMask & cullPatch) == 0u || (view.cullMask & cullOcclusion) == 0u)
        return false;
    const vec3 margin = vec3(patchMargin(view, cell, widest));
    return isHidden(cell.boundsLow - margin, cell.boundsHigh + margin);
}

/// `isLeaf`: its children, if any, are tested elsewhere.
Step stepOf(Eyepoint view, Patch cell, Subtree below, bool isLeaf)
{
    Step next = Step(0u, 0u, false, 0u, 0u);
    const uint blades = isLeaf ? cell.bladeCount : below.blades;
    if (blades == 0u)
        return next;
    if (patchCulled(view, cell, below.widest) || nodeHidden(view, cell, below.widest)) {
        next.unseen = blades;
        return next;
    }
    const bool countsEachBlade = uvec2(CULL_VIEW.cullResults) != uvec2(0u);
    next.children = isLeaf ? 0u : cell.childCount;
    if (next.children > 0u && !countsEachBlade && thinnedBelow(view, cell, below.rankBelow)) {
        next.children = 0u;
        next.thinned = blades - cell.bladeCount;
    }
    next.wanted = thickEnough(view, cell);
    next.isVisible = cell.bladeCount > 0u && (next.wanted > 0u || countsEachBlade);
    if (!next.isVisible)
        next.thinned += cell.bladeCount;
    return next;
}

/// Raises the number of work-groups of a level to at least min(`groups`, maxGroups).
void startGroups(uint level, uint groups)
{
    WalkLevelArray levels = push.levels;
    atomicMax(levels.at[level].groups[0], min(groups, maxGroups));
    levels.at[level].groups[1] = 1u;
    levels.at[level].groups[2] = 1u;
}

void main()
{
    const uint thread = gl_LocalInvocationIndex;
    const Eyepoint view = CULL_VIEW.view;
    WalkLevelArray levels = push.levels;
    const uint count = push.level == 0u ? push.startCount : levels.at[push.level].count;
    // The queue holds the levels one after the other, from the second.
    uint first = 0u;
    for (uint level = 1u; level < push.level; ++level)
        first += levels.at[level].count;
    const uint firstOfNext = push.level == 0u ? 0u : first + count;

    for (uint base = gl_WorkGroupID.x * walkThreads; base < count;
         base += gl_NumWorkGroups.x * walkThreads) {
        if (thread == 0u) {
            childTotal = 0u;
            visibleTotal = 0u;
            unseenTotal = 0u;
            thinnedTotal = 0u;
        }
        barrier();

        Step next = Step(0u, 0u, false, 0u, 0u);
        uint node = 0u;
        uint firstChild = 0u;
        if (base + thread < count) {
            node = push.level == 0u ? base + thread : push.queue.at[first + base + thread];
            Patch cell = CULL_VIEW.patches.at[node];
            if (!isPresent(uvec2(CULL_VIEW.pages), cell))
                cell.bladeCount = 0u;
            firstChild = cell.firstChild;
            next = stepOf(view, cell, push.subtrees.at[node],
                          push.level == 0u && firstChild < push.startCount);
        }
        const uint childPlace = next.children > 0u ? atomicAdd(childTotal, next.children) : 0u;
        const uint visiblePlace = next.isVisible ? atomicAdd(visibleTotal, 1u) : 0u;
        if (next.unseen > 0u)
            atomicAdd(unseenTotal, next.unseen);
        if (next.thinned > 0u)
            atomicAdd(thinnedTotal, next.thinned);
        barrier();

        // One atomic per group for each list and each count.
        if (thread == 0u) {
            if (childTotal > 0u) {
                const uint level = push.level + 1u;
                childBase = atomicAdd(levels.at[level].count, childTotal);
                startGroups(level, (childBase + childTotal + walkThreads - 1u) / walkThreads);
            }
            if (visibleTotal > 0u) {
                visibleBase = atomicAdd(levels.at[visibleLevel].count, visibleTotal);
                startGroups(visibleLevel, updateGroups(visibleBase + visibleTotal, patchesOfGroup));
            }
            if (unseenTotal > 0u)
                atomicAdd(CULL_VIEW.draw.at[0].cullResults[cullResultPatch], unseenTotal);
            if (thinnedTotal > 0u)
                atomicAdd(CULL_VIEW.draw.at[0].cullResults[cullResultLod], thinnedTotal);
        }
        barrier();
        for (uint child = 0u; child < next.children; ++child)
            push.queue.at[firstOfNext + childBase + childPlace + child] = firstChild + child;
        if (next.isVisible)
            push.visiblePatches.at[visibleBase + visiblePlace] = VisiblePatch(node, next.wanted);
        barrier();
    }
}
