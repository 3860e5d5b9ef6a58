// Moves the blades of the visible patches, culls each, and lists the drawn ones. A work-group takes a patch.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/shared/patch_tree.h"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/shared/physics.h"
#include "shaders/shared/visibility.h"
#include "web/shaders/webgpu/hidden_by_ground.glsl"

layout(local_size_x = 64) in;

layout(binding = 16) buffer PatchTimes { uint patchTimes[]; }; // tick of the last motion

shared uint kept;
shared uint listBase;
// Number in the patch, factors, pixels.
shared uvec4 survivors[maxPatchBlades];

void main()
{
    const uint thread = gl_LocalInvocationIndex;
    const uint place = gl_WorkGroupID.y * groupsOfRow + gl_WorkGroupID.x;
    const uint count = min(counters[countPatches], push.patchCount);
    const VisiblePatch item = visiblePatches[min(place, max(count, 1u) - 1u)];
    const uint wanted = place < count ? item.count : 0u;
    const uint patchIndex = item.patchIndex;
    const Patch cell = patches[patchIndex];
    const LeafAreaLimit limit = leafAreaLimitOf(FRAME.view, cell);
    const float elapsed = secondsBetween(patchTimes[patchIndex], push.tick);
    if (thread == 0u)
        kept = 0u;
    barrier();
    for (uint i = thread; i < wanted; i += 64u) {
        const uint index = cell.firstBlade + i;
        const Blade blade = unpackBlade(blades[index], cell);
        uint turn = states[index];
        const bool isNew = turn == unsettledTurn;
        const float since = isNew ? settlingTime : elapsed;
        if (since > 0.0) {
            ColliderMask none;
            turn = advanceBlade(blade, FRAME.environment, none, BladeState(isNew ? 0u : turn, 0.0), 0.0, since).turn;
            states[index] = turn;
        }
        uint number = 0u;
        PosedBlade drawn = posedBlade(raised(blade, limit.height), BladeState(turn, 0.0));
        if (mayHaveOrgans) {
            const Species species = FRAME.species.at[blade.species];
            number = ribbonNumber(species, blade);
            if (number > 0u)
                drawn = ribbonOf(FRAME.organs, species, drawn, number);
        }
        // A plant is thinned out as a whole.
        const Verdict verdict = cullBlade(FRAME.view, limit, drawn, bladeRank(cell, i - min(number, i)));
        if (verdict.cullResult == cullResultDrawn && !isHidden(drawn.v0, drawn.v1, drawn.v2, verdict.margin))
            survivors[atomicAdd(kept, 1u)] = uvec4(i, packFactors(verdict.widthFactor, limit.height),
                                                   floatBitsToUint(verdict.pixels), 0u);
    }
    barrier();
    if (thread == 0u && wanted > 0u) {
        listBase = atomicAdd(counters[countBlades], kept);
        atomicAdd(counters[countMoved], wanted);
        patchTimes[patchIndex] = push.tick;
    }
    barrier();
    for (uint i = thread; i < kept; i += 64u) {
        const uvec4 survivor = survivors[i];
        if (listBase + i < push.capacity)
            visible[listBase + i] =
                VisibleBlade(cell.firstBlade + survivor.x, patchIndex, survivor.y, uintBitsToFloat(survivor.z));
    }
}
