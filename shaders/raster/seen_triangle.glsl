// Triangles in homogeneous coordinates (Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates",
// 1997): correct on both sides of the near plane, without clipping.
#ifndef SWARD_RASTER_SEEN_TRIANGLE_GLSL
#define SWARD_RASTER_SEEN_TRIANGLE_GLSL

#extension GL_EXT_control_flow_attributes : require

#include "shaders/raster/visibility.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/ribbon.h"

// Whether there are folded blades; known at pipeline creation.
layout(constant_id = idMayFold) const bool mayFold = true;

bool isFolded(Ribbon ribbon)
{
    return mayFold && ribbon.fold > 0.0;
}

/// Pixels times w, pixels times w, reversed depth times w, w.
vec4 seenPoint(Lens lens, vec3 position)
{
    const vec4 clip = lens.viewProjection * vec4(position, 1.0);
    return vec4((0.5 * clip.xy + 0.5 * clip.w) * lens.size, clip.z, clip.w);
}

/// A cross-section in the view.
struct SeenSection {
    CrossSection section;
    vec4 left;
    vec4 right;
    vec4 ridge;
};

SeenSection seenSection(Lens lens, Ribbon ribbon, float t)
{
    SeenSection seen;
    seen.section = crossSectionAt(ribbon, t, lens.eye, lens.minWidth);
    seen.left = seenPoint(lens, seen.section.left);
    seen.right = seenPoint(lens, seen.section.right);
    // Without a fold the ridge is halfway between the edges, here too.
    seen.ridge = 0.5 * (seen.left + seen.right);
    if (isFolded(ribbon))
        seen.ridge = seenPoint(lens, seen.section.ridge);
    return seen;
}

/// Whether a point lies before the near plane or behind the eye.
bool isBefore(vec4 seen)
{
    return seen.w <= 0.0 || seen.z > seen.w;
}

/// Number of triangles between two sections.
uint trianglesOf(bool isFolded)
{
    return isFolded ? 4u : 2u;
}

/// One of the triangles between two cross-sections, split as a tessellator does, see upperHalf(). The quad has corners
/// a, b on the first section and c, d on the second, a and c to the left. In a folded ribbon it ends or begins at the
/// ridge. The triangle's first corner is a or b, the second b or d, the third c or d.
struct TriangleOf {
    bool isRight;     ///< the quad begins at the ridge
    bool endsAtRidge; ///< the quad ends at the ridge
    bool isSecond;    ///< its second corner is d
    bool beginsRight; ///< its first corner is b
    bool endsLeft;    ///< its third corner is c
};

TriangleOf triangleOf(uint i, bool isFolded, bool isUpper)
{
    TriangleOf part;
    part.isRight = i >= 2u;
    part.endsAtRidge = isFolded && i < 2u;
    part.isSecond = (i & 1u) != 0u;
    part.beginsRight = part.isSecond && isUpper;
    part.endsLeft = part.isSecond || isUpper;
    return part;
}

float crossOf(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/// The point of a triangle at a place of the picture.
struct SeenPoint {
    vec3 shares; ///< barycentric weights in space; none is negative inside
    float depth; ///< reversed; above 1 before the near plane
    float least; ///< smallest weight; −1e9 where the ray misses the triangle's plane
};

SeenPoint seenAt(vec4 a, vec4 b, vec4 c, vec2 place)
{
    // Relative to the place, the weights are the areas opposite to the corners.
    const vec2 p = a.xy - place * a.w;
    const vec2 q = b.xy - place * b.w;
    const vec2 r = c.xy - place * c.w;
    const vec3 areas = vec3(q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x);
    const float sum = areas.x + areas.y + areas.z;
    SeenPoint seen;
    seen.shares = sum != 0.0 ? areas / sum : vec3(0.0);
    const float w = dot(seen.shares, vec3(a.w, b.w, c.w));
    seen.depth = w > 0.0 ? dot(seen.shares, vec3(a.z, b.z, c.z)) / w : 0.0;
    seen.least = w > 0.0 && sum != 0.0 ? min(min(seen.shares.x, seen.shares.y), seen.shares.z) : -1e9;
    return seen;
}

#endif
