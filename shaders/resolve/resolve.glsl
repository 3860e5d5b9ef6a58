// Shades the surfaces in a visibility.
#ifndef SWARD_RESOLVE_RESOLVE_GLSL
#define SWARD_RESOLVE_RESOLVE_GLSL

#include "shaders/resolve/known_blade.glsl"
#include "shaders/resolve/shade_found.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/visibility.h"
#include "shaders/common/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

// Whether a work-group's tile may contain blades, and sky; known at pipeline creation.
layout(constant_id = idShowsBlades) const bool showsBlades = true;
layout(constant_id = idShowsSky) const bool showsSky = true;

/// The film colour of a blade, and 1 − softness, in the middle of the pixel's samples (bits `samples`) that show it.
/// `depth` is its depth at sample `s`, one of these.
vec4 shade(Lens lens, SeenBlade seen, vec2 pixel, uint samples, uint s, float depth)
{
    const Sighting sighting = Sighting(pixel + samplePlace(s), depth, pixel + middleOf(samples));
    const Found found = find(lens, seen.ribbon, sighting);
    noteVisible(seen, found.place.y);
    return shadeFound(seen, found);
}

/// The film colour of the sky at a pixel.
vec4 skyAt(Lens lens, uvec2 pixel)
{
    const vec2 middle = vec2(pixel) + 0.5;
    return vec4(skyPicture(normalize(rayTo(lens, middle)), middle), 1.0);
}

#endif
