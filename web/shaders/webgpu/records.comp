// The curves of the visible blades, for tests: 12 words each, v0 and the blade, v1 and its width, v2.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/blade/drawn_blade.glsl"

layout(local_size_x = 64) in;

layout(binding = 23) buffer Records { vec4 records[]; };

void main()
{
    const uint place = (gl_WorkGroupID.y * groupsOfRow + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (place >= min(counters[countBlades], push.capacity))
        return;
    const VisibleBlade item = visible[place];
    const Ribbon ribbon = drawnBlade(item).ribbon;
    records[3u * place] = vec4(ribbon.v0, uintBitsToFloat(item.blade));
    records[3u * place + 1u] = vec4(ribbon.v1, ribbon.width);
    records[3u * place + 2u] = vec4(ribbon.v2, 0.0);
}
