// The light of a visible place of a blade.
#ifndef SWARD_RESOLVE_SHADE_FOUND_GLSL
#define SWARD_RESOLVE_SHADE_FOUND_GLSL

#include "shaders/blade/blade_light.glsl"
#include "shaders/raster/seen_blade.glsl"
#include "shaders/raster/seen_place.glsl"

/// The place as a point to be lit.
BladePoint pointOf(SeenBlade seen, Found found)
{
    const Ribbon ribbon = seen.ribbon;
    BladePoint point;
    point.position = found.point;
    point.place = found.place;
    point.tangent = tangentOf(curveOf(ribbon), point.place.y);
    point.axis = ribbon.axis;
    point.up = normalize(ribbon.v1 - ribbon.v0);
    point.fold = isFolded(ribbon) ? ribbon.fold : 0.0;
    point.rootColor = seen.surface.root;
    point.tipColor = seen.surface.tip;
    point.look = unpackedLook(seen.surface.material.x);
    point.leafAbove = leafAreaAbove(seen.surface.material, clamp(found.place.y, 0.0, 1.0));
    point.leafBelow = max(seen.surface.material.y - point.leafAbove, 0.0);
    point.seed = ribbon.seed;
    point.finish = seen.surface.material.w;
    point.flecks = fleckCount(length(ribbon.v1 - ribbon.v0) + length(ribbon.v2 - ribbon.v1));
    return point;
}

/// The film colour of the place, and 1 − softness.
vec4 shadeFound(SeenBlade seen, Found found)
{
    const BladePoint point = pointOf(seen, found);
    return vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - point.position), 1.0));
}

#endif
