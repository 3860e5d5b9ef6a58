// Shades what a visibility holds.
#include "shaders/raster/shading_cache.glsl"
#include "shaders/raster/shade_found.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/sky/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

// Whether there may be blades in a work-group's tile, and sky; known when the pipeline is made.
layout(constant_id = 12) const bool showsBlades = true;
layout(constant_id = 13) const bool showsSky = true;

/// Whether surfaces of large blades have been kept; known when the pipeline is made.
layout(constant_id = 15) const bool hasShadingCache = false;

SeenBlade seenBlade(uint index)
{
    SeenBlade seen;
    if (hasShadingCache && findCached(index, seen))
        return seen;
    return freshBlade(index);
}

/// Notes in the visibility history that one quarter of the blade is seen. `along`: 0 at its root.
void noteSeen(SeenBlade blade, float along)
{
    if (!blade.hasHistory)
        return;
    UintArray seen = push.seen;
    const float segments = blade.ribbon.outline.segments;
    const float segment = min(floor(max(along, 0.0) * segments), segments - 1.0);
    const uint word = blade.blade / seenOfWord;
    const uint bit = seenBit(blade.blade, quarterOf(segment, segments));
    // Many pixels show the same quarter: a read is cheaper than an atomic.
    if ((seen.at[word] & bit) == 0u)
        atomicOr(seen.at[word], bit);
}

/// What the film sees of a blade in the middle of the samples of a pixel, as bits, at which it is
/// seen, and 1 − softness. It lies at `depth` at one of them, `s`.
vec4 shade(Lens lens, SeenBlade seen, vec2 pixel, uint samples, uint s, float depth)
{
    const Sighting sighting = Sighting(pixel + samplePlace(s), depth, pixel + middleOf(samples));
    const Found found = find(lens, seen.ribbon, sighting);
    noteSeen(seen, found.place.y);
    return shadeFound(seen, found);
}

/// What the film sees of the sky at a pixel.
vec4 skyAt(Lens lens, uvec2 pixel)
{
    const vec2 middle = vec2(pixel) + 0.5;
    return vec4(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);
}
