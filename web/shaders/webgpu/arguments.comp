// Sizes of the dispatches that follow, from the counts so far.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/shared/patch_tree.h"
#include "web/shaders/webgpu/listed_quads.glsl"

layout(local_size_x = 1) in;

void argue(uint first, uint groups, uint count)
{
    arguments[first] = min(groups, groupsOfRow);
    arguments[first + 1u] = (groups + groupsOfRow - 1u) / groupsOfRow;
    arguments[first + 2u] = 1u;
    arguments[first + 3u] = count;
}

void main()
{
    const uint cells = min(counters[countPatches], push.patchCount);
    argue(argumentsPatches, cells, cells);
    const uint drawn = min(counters[countBlades], push.capacity);
    argue(argumentsBlades, (drawn + 63u) / 64u, drawn);
    const uint rows = min(counters[countRows], maxRowBlocks);
    argue(argumentsRows, (rows + rowBlocksOfGroup - 1u) / rowBlocksOfGroup, rows);
}
