// What a pixel shows of the ground, from a triangle and its depth alone.
#ifndef SWARD_LAYERS_GROUND_LAYER_GLSL
#define SWARD_LAYERS_GROUND_LAYER_GLSL

#include "shaders/common/lighting.glsl"
#include "shaders/preview/base_colors.glsl"
#include "shaders/raster/seen_place.glsl"
#include "shaders/shared/layers/layers_table.h"

/// The corners of a triangle of the ground.
struct GroundCorners {
    GroundVertex a;
    GroundVertex b;
    GroundVertex c;
};

GroundCorners groundCorners(LayersTable table, uint triangle)
{
    return GroundCorners(table.vertices.at[table.indices.at[3u * triangle]],
                         table.vertices.at[table.indices.at[3u * triangle + 1u]],
                         table.vertices.at[table.indices.at[3u * triangle + 2u]]);
}

/// Barycentric weights of the place where a ray from the eye meets the triangle's plane.
vec3 sharesAlong(GroundCorners corners, vec3 eye, vec3 ray)
{
    const vec3 a = corners.a.position - eye;
    const vec3 b = corners.b.position - eye;
    const vec3 c = corners.c.position - eye;
    const vec3 volumes = vec3(dot(ray, cross(b, c)), dot(ray, cross(c, a)), dot(ray, cross(a, b)));
    const float sum = volumes.x + volumes.y + volumes.z;
    return volumes / (abs(sum) < 1e-30 ? 1e-30 : sum);
}

/// The same inside the triangle.
vec3 sharesInside(vec3 shares)
{
    const vec3 inside = max(shares, vec3(0.0));
    return inside / max(inside.x + inside.y + inside.z, 1e-30);
}

/// Interpolated normal of the side that is seen.
vec3 groundNormal(GroundCorners corners, vec3 shares, uint flags, vec3 ray)
{
    const vec3 n = normalize(mat3(decodeNormal32(corners.a.normal), decodeNormal32(corners.b.normal),
                                  decodeNormal32(corners.c.normal)) *
                             shares);
    return (flags & groundDoubleSided) != 0u && dot(n, ray) > 0.0 ? -n : n;
}

/// Albedo of material, image, vertices, and of the undergrowth on it, as of the traced reference; false if another
/// dispatch has the image.
bool groundAlbedo(LayersTable table, uint firstImage, GroundMaterial material, GroundCorners corners, Lens lens,
                  vec2 middle, vec3 position, out vec3 albedo)
{
    albedo = vec3(0.0);
    const uint image = min(material.image, table.imageCount - 1u) - firstImage;
    if (image >= imagesTogether)
        return false;
    const vec3 here = sharesAlong(corners, lens.eye, rayTo(lens, middle));
    const vec3 right = sharesAlong(corners, lens.eye, rayTo(lens, middle + vec2(1.0, 0.0))) - here;
    const vec3 down = sharesAlong(corners, lens.eye, rayTo(lens, middle + vec2(0.0, 1.0))) - here;
    const vec3 shares = sharesInside(here);
    const mat3x2 uvs = mat3x2(corners.a.uv, corners.b.uv, corners.c.uv);
    const vec3 tint = mat3(unpackUnorm4x8(corners.a.color).rgb, unpackUnorm4x8(corners.b.color).rgb,
                           unpackUnorm4x8(corners.c.color).rgb) *
                      shares;
    albedo = material.baseColor.rgb * tint * probedTexel(image, uvs * shares, uvs * right, uvs * down);
    const vec3 grass = grassAt(FRAME.cover, position);
    albedo = clamp(groundUnder(FRAME.cover, albedo, meadowShade(position, toneOf(grass)), FRAME.cover.thinned * grass.x),
                   0.0, 1.0);
    return true;
}

/// Share of the sun's light that shadows and leaves let through to a place of the ground.
float sunOnGround(vec3 position, vec3 n)
{
    const float even = max(dot(n, FRAME.sunDirection), 0.0);
    if (even <= 0.0)
        return 0.0;
    const float leafArea = FRAME.cover.thinned * grassAt(FRAME.cover, position).x;
    const vec2 among = sunAmongBlades(FRAME.bladeShadow, position, noBladeSeed);
    return sunSeen(FRAME.shadow, position, n) *
           mix(sunBelow(leafProjectionOf(FRAME.cover), leafArea, even), among.x, among.y);
}

#endif
