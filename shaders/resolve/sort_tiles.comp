#version 460
#extension GL_GOOGLE_include_directive : require
// Tile classification: sorts the tiles of a picture by their content, for the shading passes.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/raster/put_sample.glsl"
#include "shaders/resolve/tile_classification.glsl"

layout(local_size_x = sortThreads) in;

// Content of a tile, as bits.
const uint showsSky = 1u;
const uint showsOpaque = 2u;
const uint showsBlades = 4u;

uint shownIn(uvec2 low)
{
    VisibilityHalves halves = VisibilityHalves(uvec2(push.visibility));
    const uvec2 high = min(low + rasterTile, push.size);
    uint shown = 0u;
    for (uint x = low.x; x < high.x; ++x)
        for (uint y = low.y; y < high.y; ++y)
            for (uint s = 0u; s < samplesPerPixel; ++s) {
                const uint what = halves.at[2u * sampleIndex(uvec2(x, y), s)];
                shown |= what == 0u ? showsSky : what < push.firstBlade ? showsOpaque : showsBlades;
            }
    return shown;
}

void main()
{
    const uint columns = tilesAlong(push.size.x, lightTile);
    const uvec2 large = uvec2(gl_GlobalInvocationID.x % columns, gl_GlobalInvocationID.x / columns);
    if (large.y >= tilesAlong(push.size.y, lightTile))
        return;
    const uint along = lightTile / rasterTile;
    uint all = 0u;
    for (uint i = 0u; i < along * along; ++i) {
        const uvec2 tile = along * large + uvec2(i % along, i / along);
        const uint shown = shownIn(tile * rasterTile);
        all |= shown;
        if (shown == 0u) // outside the picture
            continue;
        const bool hasSky = (shown & showsSky) != 0u;
        putTile((shown & showsBlades) == 0u ? tilesWithoutBlades : hasSky ? tilesOfBladesAndSky : tilesOfBlades, tile);
    }
    if ((all & showsOpaque) != 0u)
        putTile(tilesOfOpaque, large);
}
