// Finds the patches whose blades a view may show, one thread for each node of the patch tree.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/shared/patch_tree.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/visibility.h"
#include "web/shaders/webgpu/hidden_by_ground.glsl"

layout(local_size_x = 64) in;

layout(binding = 14) buffer Widest { float widest[]; };  // Subtree::widest of each node
layout(binding = 15) buffer Present { uint present[]; }; // a bit for each page of blades that is here

bool isHere(uint page)
{
    return (present[page / 32u] & (1u << (page % 32u))) != 0u;
}

void main()
{
    const uint node = gl_WorkGroupID.y * groupsOfRow * 64u + gl_GlobalInvocationID.x;
    if (node >= push.patchCount)
        return;
    const Patch cell = patches[node];
    if (cell.bladeCount == 0u || patchCulled(FRAME.view, cell, widest[node]))
        return;
    const vec3 margin = vec3(patchMargin(FRAME.view, cell, widest[node]));
    if (isHidden(cell.boundsLow - margin, cell.boundsHigh + margin))
        return;
    const uint count = thickEnough(FRAME.view, cell);
    if (count == 0u || !isHere(cell.firstBlade / pageBlades) ||
        !isHere((cell.firstBlade + count - 1u) / pageBlades))
        return;
    visiblePatches[atomicAdd(counters[countPatches], 1u)] = VisiblePatch(node, count);
}
