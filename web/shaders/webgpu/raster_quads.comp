// Rasterises the listed quads: a thread draws a row.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/raster/span.glsl"
#include "web/shaders/webgpu/listed_quads.glsl"

layout(local_size_x = 64) in;

void main()
{
    const uint place = (gl_WorkGroupID.y * groupsOfRow + gl_WorkGroupID.x) * rowBlocksOfGroup +
                       gl_LocalInvocationIndex / rowsOfBlock;
    if (place >= min(counters[countRows], maxRowBlocks))
        return;
    const uint listed = rowBlocks[place];
    if (listed == noRowBlock)
        return;
    const uint slot = listed & (maxQuads - 1u);
    const vec4 a = quads[5u * slot];
    const vec4 b = quads[5u * slot + 1u];
    const vec4 c = quads[5u * slot + 2u];
    const vec4 d = quads[5u * slot + 3u];
    const vec4 e = quads[5u * slot + 4u];
    const Quad quad = Quad(a.xyz, b.xyz, c.xyz, d.xyz, vec2(a.w, b.w), vec2(c.w, d.w), e.xy);
    const ivec2 rows = rowsBetween(min(min(a.y, b.y), min(c.y, d.y)), max(max(a.y, b.y), max(c.y, d.y)),
                                   float(push.size.y));
    const int row = rows.x + int((listed >> quadBits) * rowsOfBlock + gl_LocalInvocationIndex % rowsOfBlock);
    Span span;
    if (row <= rows.y && spanOfQuad(quad, isThin(quad), span))
        drawRow(span, floatBitsToUint(e.z), floatBitsToUint(e.w), row);
}
