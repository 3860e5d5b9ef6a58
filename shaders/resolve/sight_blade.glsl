// A blade where a pixel of a host's view shows it.
#ifndef SWARD_RESOLVE_SIGHT_BLADE_GLSL
#define SWARD_RESOLVE_SIGHT_BLADE_GLSL

// The set of the host's shadow map follows that of the frame, if there is one.
#ifdef HAS_INSTANCES
#define HOST_LIGHT 0
#else
#define HOST_LIGHT 1
#endif

#include "shaders/raster/instances.glsl"
#include "shaders/raster/put_sample.glsl"
#include "shaders/resolve/shade_found.glsl"
#ifndef HAS_INSTANCES
#include "shaders/resolve/known_blade.glsl"
#endif

struct SightedBlade {
    Lens lens;
    SeenBlade seen;
    Found found;
    uint instance;
};

/// `what`: its value in the visibility; `samples`: bits of the samples that show it; `depth`: at sample `middle` of
/// these. Selects its instance.
SightedBlade sightBlade(uvec2 pixel, uint what, uint samples, uint middle, float depth)
{
    SightedBlade blade;
#ifdef HAS_INSTANCES
    blade.instance = instanceOf(what);
    chooseInstance(blade.instance);
    blade.lens = lensOf();
    blade.seen = freshBlade(what - push.firstBlade);
#else
    blade.instance = 0u;
    blade.lens = lensOf();
    blade.seen = seenBlade(what - push.firstBlade);
#endif
    blade.found = find(blade.lens, blade.seen.ribbon,
                       Sighting(vec2(pixel) + samplePlace(middle), depth, vec2(pixel) + middleOf(samples)));
#ifndef HAS_INSTANCES
    noteVisible(blade.seen, blade.found.place.y);
#endif
    return blade;
}

/// Notes that the tile of a pixel shows a blade. All pixels of a tile store the same value.
void noteTile(uvec2 pixel)
{
    UintArray tiles = host.tiles;
    const uvec2 tile = pixel / hostTile;
    tiles.at[tile.y * tilesAlong(host.size.x, hostTile) + tile.x] = 1u;
}

#endif
