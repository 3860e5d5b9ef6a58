#version 460
#extension GL_GOOGLE_include_directive : require
// Tiles of a host's picture, six vertices each. A tile without blades collapses: fragments cost more than vertices.
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { HostViewPush host; };

layout(location = 0) out vec2 outPlace; // 0 … 1, to the right and downwards

void main()
{
    const uint tile = uint(gl_VertexIndex) / 6u;
    const uint corner = uint(gl_VertexIndex) % 6u;
    const uint row = tilesAlong(host.size.x, hostTile);
    // Two triangles: 0 1 2 and 2 1 3, of corners counted row by row.
    const uint number = corner < 3u ? corner : corner == 3u ? 2u : corner == 4u ? 1u : 3u;
    const uvec2 first = uvec2(tile % row, tile / row);
    const uvec2 pixel = min((first + uvec2(number & 1u, number >> 1u)) * hostTile, host.size);
    outPlace = vec2(pixel) / vec2(host.size);
    gl_Position = host.tiles.at[tile] != 0u ? vec4(2.0 * outPlace - 1.0, 0.0, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}
