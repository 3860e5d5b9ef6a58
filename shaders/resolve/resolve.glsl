// Shades the surfaces in a visibility.
#include "shaders/resolve/shading_cache.glsl"
#include "shaders/resolve/shade_found.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/preview/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

// Whether a work-group's tile may contain blades, and sky; known at pipeline creation.
layout(constant_id = 12) const bool showsBlades = true;
layout(constant_id = 13) const bool showsSky = true;

/// Whether the shading cache is filled; known at pipeline creation.
layout(constant_id = 15) const bool hasShadingCache = false;

SeenBlade seenBlade(uint index)
{
    SeenBlade seen;
    if (hasShadingCache && findCached(index, seen))
        return seen;
    return freshBlade(index);
}

/// Records in the visibility history that a quarter of the blade is visible. `along`: 0 at its root.
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

/// The film colour of a blade, and 1 − softness, in the middle of the pixel's samples (bits `samples`) that show it.
/// `depth` is its depth at sample `s`, one of these.
vec4 shade(Lens lens, SeenBlade seen, vec2 pixel, uint samples, uint s, float depth)
{
    const Sighting sighting = Sighting(pixel + samplePlace(s), depth, pixel + middleOf(samples));
    const Found found = find(lens, seen.ribbon, sighting);
    noteSeen(seen, found.place.y);
    return shadeFound(seen, found);
}

/// The film colour of the sky at a pixel.
vec4 skyAt(Lens lens, uvec2 pixel)
{
    const vec2 middle = vec2(pixel) + 0.5;
    return vec4(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);
}
