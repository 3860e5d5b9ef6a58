// Cross-sections on the screen, and the quads between them.
#ifndef SWARD_RASTER_SCREEN_SECTION_GLSL
#define SWARD_RASTER_SCREEN_SECTION_GLSL

#include "shaders/raster/put_sample.glsl"
#include "shaders/raster/seen_triangle.glsl"

/// A cross-section on the screen.
struct ScreenSection {
    vec3 left; ///< pixels, pixels, reversed depth
    vec3 right;
    vec3 ridge;
    vec2 weight; ///< CrossSection::wide, CrossSection::drawn, per w, so that their ratio interpolates correctly
};

/// Corners are snapped to 1 / subpixels of a pixel, as in a GPU's rasteriser.
const float subpixels = 256.0;

vec3 screenPoint(vec4 seen)
{
    const float inverse = 1.0 / seen.w;
    return vec3(round(seen.xy * (inverse * subpixels)) / subpixels, seen.z * inverse);
}

/// Projects a section behind the near plane. Only a folded ribbon has a ridge.
ScreenSection screenSection(SeenSection seen, bool isFolded)
{
    ScreenSection screen;
    screen.left = screenPoint(seen.left);
    screen.right = screenPoint(seen.right);
    screen.ridge = screen.left;
    if (isFolded)
        screen.ridge = screenPoint(seen.ridge);
    screen.weight = vec2(seen.section.wide, seen.section.drawn) / seen.ridge.w;
    return screen;
}

/// A convex part of the surface between two cross-sections: corners a0 and a1 on one section, b0 and b1 on the other,
/// each with screen place and reversed depth. b0 equals b1 in a triangle.
struct Quad {
    vec3 a0;
    vec3 a1;
    vec3 b0;
    vec3 b1;
    vec2 weightA0; ///< ScreenSection::weight at a0 …
    vec2 weightA1; ///< … at a1 …
    vec2 weightB;  ///< … and in the middle of b0 and b1
};

/// Number of parts between two cross-sections: a folded ribbon has two.
uint halvesOf(bool isFolded)
{
    return isFolded ? 2u : 1u;
}

/// One of these parts. A twisted part must be drawn as triangles.
Quad halfOf(uint i, ScreenSection before, ScreenSection after, bool isFolded)
{
    const bool isRight = i > 0u;
    const bool endsAtRidge = isFolded && !isRight;
    return Quad(isRight ? before.ridge : before.left, endsAtRidge ? before.ridge : before.right,
                isRight ? after.ridge : after.left, endsAtRidge ? after.ridge : after.right,
                before.weight, before.weight, after.weight);
}

/// One of the triangles: see triangleOf().
Quad triangleBetween(uint i, ScreenSection before, ScreenSection after, bool isFolded, bool isUpper)
{
    const TriangleOf part = triangleOf(i, isFolded, isUpper);
    const Quad whole = halfOf(i / 2u, before, after, isFolded);
    Quad quad;
    // Two of its corners lie on the same section.
    quad.a0 = part.isSecond ? whole.b1 : whole.a0;
    quad.a1 = part.isSecond ? whole.b0 : whole.a1;
    quad.b0 = part.isSecond ? (part.beginsRight ? whole.a1 : whole.a0)
                            : (part.endsLeft ? whole.b0 : whole.b1);
    quad.b1 = quad.b0;
    quad.weightA0 = part.isSecond ? after.weight : before.weight;
    quad.weightA1 = quad.weightA0;
    quad.weightB = part.isSecond ? before.weight : after.weight;
    return quad;
}

/// Whether the quad is convex or degenerates to a line.
bool isConvex(Quad quad)
{
    const vec2 a = quad.a1.xy - quad.a0.xy;
    const vec2 b = quad.b1.xy - quad.a1.xy;
    const vec2 c = quad.b0.xy - quad.b1.xy;
    const vec2 d = quad.a0.xy - quad.b0.xy;
    const vec4 turns = vec4(crossOf(a, b), crossOf(b, c), crossOf(c, d), crossOf(d, a));
    return all(greaterThanEqual(turns, vec4(0.0))) || all(lessThanEqual(turns, vec4(0.0)));
}

#endif
