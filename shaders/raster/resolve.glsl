// Shades what a visibility holds.
#include "shaders/grass/blade_colors.glsl"
#include "shaders/grass/blade_light.glsl"
#include "shaders/raster/seen_triangle.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/sky/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

/// Whether grass that others hide is left out, see layerShare(); known when the pipeline is made.
layout(constant_id = 8) const bool leavesLayers = true;

// Whether there may be blades in a work-group's tile, and sky; known when the pipeline is made.
layout(constant_id = 12) const bool showsBlades = true;
layout(constant_id = 13) const bool showsSky = true;

/// Index of the patch that owns a blade.
uint patchOf(uint blade)
{
    uint owner = push.firstOwners.at[blade / ownerStride];
    uint patchIndex = push.owners.at[owner];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.owners.at[++owner];
    return patchIndex;
}

/// A blade of patch `patchIndex`, raised() by its layers, as the list of visible blades had it.
VisibleBlade visibleBlade(uint index, uint patchIndex, Patch cell, Blade blade, Layers layers)
{
    const Eyepoint view = push.judged.at[0].view;
    const DrawnSize size = drawnSize(view, layers, blade, bladeRank(cell, index - cell.firstBlade),
                                     length(blade.root - view.eye));
    return VisibleBlade(index, patchIndex, packFactors(size.widthFactor, layers.rise), size.pixels);
}

/// A corner of a ribbon's triangle.
struct Corner {
    vec4 seen;
    vec2 place; ///< −1 … 1 across, 0 … 1 along
};

/// The best guess so far at which point of a ribbon is seen. Where it lies in space its depth says: to
/// remember that of every corner takes a device's registers, and with them the time.
struct Found {
    float error; ///< 0: its triangle is where the sample says that something is
    float depth; ///< in the middle of what is shaded
    vec2 place;  ///< as a Corner has it
};

/// Where and how deep a sample of a ribbon is seen, and the middle of all that are shaded with it
/// [pixels].
struct Sighting {
    vec2 pixel;
    float depth;
    vec2 middle;
};

/// A triangle that errs by less is the one. Corners lie in steps of a 256th of a pixel where they are
/// drawn, not here.
const float foundError = 0.02;

/// By how much a triangle errs of which a sample is said to show a point. The sample may lie just
/// outside by rounding; between triangles that both hold it depth decides.
float errorOf(SeenPoint seen, Sighting sighting)
{
    return max(-seen.least, 0.0) + abs(seen.depth / sighting.depth - 1.0);
}

/// The shares of a triangle's corners in the middle of what is shaded with a sample.
vec3 sharesInMiddle(vec4 first, vec4 second, vec4 third, SeenPoint seen, Sighting sighting)
{
    const vec3 inside = max(samplesPerPixel == 1u ? seen.shares
                                                  : seenAt(first, second, third, sighting.middle).shares,
                            vec3(0.0));
    return inside / max(inside.x + inside.y + inside.z, 1e-6);
}

/// The reversed depth where a triangle has these shares of its corners.
float depthOf(vec4 first, vec4 second, vec4 third, vec3 shares)
{
    return dot(shares, vec3(first.z, second.z, third.z)) / dot(shares, vec3(first.w, second.w, third.w));
}

/// What lies between two ribs of a ribbon without a fold, as lookAtHalves() has it: of the two
/// triangles the one on whose side of the diagonal the sample is, and the other one if that is not it.
void lookBetween(SeenRib before, SeenRib after, float low, float high, bool isUpper, Sighting sighting,
                 inout Found found)
{
    // The diagonal goes from the rib before to that after, to the right, or to the left if isUpper.
    const vec4 from = isUpper ? before.right : before.left;
    const vec4 to = isUpper ? after.left : after.right;
    const vec4 lower = isUpper ? before.left : before.right;
    const vec4 upper = isUpper ? after.right : after.left;
    const vec2 p = from.xy - sighting.pixel * from.w;
    const vec2 q = to.xy - sighting.pixel * to.w;
    const vec2 r = lower.xy - sighting.pixel * lower.w;
    // Its share of the lower corner has this sign.
    const float side = crossOf(p, q) * (crossOf(p, q) + crossOf(q, r) + crossOf(r, p));
    bool isLower = side >= 0.0;
    [[dont_unroll]] for (uint turn = 0u; turn < 2u; ++turn) {
        const vec4 third = isLower ? lower : upper;
        const SeenPoint seen = seenAt(from, to, third, sighting.pixel);
        const float error = errorOf(seen, sighting);
        if (error < found.error) {
            const vec3 shares = sharesInMiddle(from, to, third, seen, sighting);
            const float across = shares.x - shares.y + (isLower ? -shares.z : shares.z);
            found.error = error;
            found.depth = depthOf(from, to, third, shares);
            found.place = vec2(isUpper ? across : -across,
                               mix(low, high, shares.y + (isLower ? 0.0 : shares.z)));
        }
        if (found.error < foundError)
            break;
        isLower = !isLower;
    }
}

/// What lies between two ribs of a folded ribbon.
void lookAtHalves(SeenRib before, SeenRib after, float low, float high, bool isUpper, Sighting sighting,
                  inout Found found)
{
    const Corner left = Corner(before.left, vec2(-1.0, low));
    const Corner right = Corner(before.right, vec2(1.0, low));
    const Corner ridge = Corner(before.ridge, vec2(0.0, low));
    const Corner leftAfter = Corner(after.left, vec2(-1.0, high));
    const Corner rightAfter = Corner(after.right, vec2(1.0, high));
    const Corner ridgeAfter = Corner(after.ridge, vec2(0.0, high));
    [[dont_unroll]] for (uint i = 0u; i < trianglesOf(true); ++i) {
        const TriangleOf part = triangleOf(i, true, isUpper);
        const Corner a = part.isRight ? ridge : left;
        const Corner b = part.endsAtRidge ? ridge : right;
        const Corner c = part.isRight ? ridgeAfter : leftAfter;
        const Corner d = part.endsAtRidge ? ridgeAfter : rightAfter;
        const Corner first = part.beginsRight ? b : a;
        const Corner second = part.isSecond ? d : b;
        const Corner third = part.endsLeft ? c : d;
        const SeenPoint seen = seenAt(first.seen, second.seen, third.seen, sighting.pixel);
        const float error = errorOf(seen, sighting);
        if (error >= found.error)
            continue;
        const vec3 shares = sharesInMiddle(first.seen, second.seen, third.seen, seen, sighting);
        found.error = error;
        found.depth = depthOf(first.seen, second.seen, third.seen, shares);
        found.place = shares.x * first.place + shares.y * second.place + shares.z * third.place;
    }
}

/// What lies between the ribs at the places `low` and `high`.
void look(Lens lens, Ribbon ribbon, float low, float high, bool isUpper, Sighting sighting,
          inout Found found)
{
    const SeenRib before = seenRib(lens, ribbon, low);
    const SeenRib after = seenRib(lens, ribbon, high);
    if (isFolded(ribbon))
        lookAtHalves(before, after, low, high, isUpper, sighting, found);
    else
        lookBetween(before, after, low, high, isUpper, sighting, found);
}

/// Where along a ribbon a point of it lies. Seen along the axis a ribbon is a curve, and its points
/// lie on it: Gauss and Newton's way to the nearest, from where the chord has it. Wrong where a
/// ribbon is drawn much wider than it is, or runs along its own axis.
float placeAlong(Ribbon ribbon, vec3 point)
{
    const vec3 axis = ribbon.axis;
    const vec3 toMiddle = ribbon.v1 - ribbon.v0;
    const vec3 toTip = ribbon.v2 - ribbon.v0;
    const vec3 toPoint = point - ribbon.v0;
    const vec3 a = toMiddle - dot(toMiddle, axis) * axis;
    const vec3 b = toTip - dot(toTip, axis) * axis;
    const vec3 p = toPoint - dot(toPoint, axis) * axis;
    float t = clamp(dot(p, b) / max(dot(b, b), 1e-12), 0.0, 1.0);
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
        const vec3 off = bezierPoint(vec3(0.0), a, b, t) - p;
        const vec3 speed = bezierTangent(vec3(0.0), a, b, t);
        t = clamp(t - dot(off, speed) / max(dot(speed, speed), 1e-12), 0.0, 1.0);
    }
    return t;
}

/// What is seen so deep at a place of the picture, relative to the field's origin.
vec3 pointSeen(Lens lens, vec2 pixel, float depth)
{
    const vec3 ray = rayThrough(2.0 * pixel / lens.size - 1.0);
    // Clip w grows by 1 with the ray's length, from 0 at the eye.
    const vec4 depthRow = vec4(lens.viewProjection[0].z, lens.viewProjection[1].z,
                               lens.viewProjection[2].z, lens.viewProjection[3].z);
    return lens.eye + (dot(depthRow, vec4(lens.eye, 1.0)) / (depth - dot(depthRow.xyz, ray))) * ray;
}

/// Which point of a ribbon is seen: in the segment where it should be, or else in one near it, or, if
/// it is in none, in the best of all.
Found find(Lens lens, Ribbon ribbon, Sighting sighting)
{
    Found found;
    found.error = 1e30;
    const float segments = ribbon.outline.segments;
    const float place = segments > 1.5 ? placeAlong(ribbon, pointSeen(lens, sighting.pixel, sighting.depth)) : 0.0;
    float segment = clamp(floor(place * segments) + 1.0, 1.0, segments);
    // By how much the next one is farther along: the neighbour that is nearer first, then by turns.
    float step_ = fract(place * segments) < 0.5 ? -1.0 : 1.0;
    [[dont_unroll]] for (float turn = 0.0; turn < 2.0 * segments; turn += 1.0) {
        if (segment >= 1.0 && segment <= segments)
            look(lens, ribbon, (segment - 1.0) / segments, segment / segments,
                 upperHalf(segment, segments), sighting, found);
        if (found.error < foundError || segments < 1.5)
            break;
        segment += step_;
        step_ = -step_ - sign(step_);
    }
    return found;
}

/// In the next frame one half of the blade counts as seen, if that is asked of it. `along`: 0 at its root.
void noteSeen(VisibleBlade visible, DrawnBlade drawn, float along)
{
    if (uvec2(push.seen) == uvec2(0u) ||
        pixelsCovered(drawn.blade, visible.pixels, widthFactorOf(visible)) <= askedSmallPixels)
        return;
    UintArray seen = push.seen;
    const float segments = drawn.ribbon.outline.segments;
    const uint half_ = along * segments < floor(0.5 * segments) ? 0u : 1u;
    const uint word = visible.blade / 16u;
    const uint bit = 1u << (2u * (visible.blade % 16u) + half_);
    if ((seen.at[word] & bit) == 0u)
        atomicOr(seen.at[word], bit);
}

/// What the film sees of a blade in the middle of the samples of a pixel, as bits, at which it is
/// seen, and 1 − softness. It lies at `depth` at one of them, `s`.
vec4 shade(Lens lens, uint index, vec2 pixel, uint samples, uint s, float depth)
{
    // Read first: to find the patch takes as long.
    const uint place = placeOf(uvec2(FRAME.pages), index);
    const PackedBlade bits = FRAME.blades.at[place];
    const BladeState state = BladeState(FRAME.states.at[place], 0.0);
    const uint patchIndex = patchOf(index);
    const Patch cell = FRAME.patches.at[patchIndex];
    Layers layers = allLayers();
    if (leavesLayers)
        layers = layersOf(push.judged.at[0].view, cell);
    const Blade blade = raised(unpackBlade(bits, cell), layers.rise);
    const VisibleBlade visible = visibleBlade(index, patchIndex, cell, blade, layers);
    const DrawnBlade drawn = drawnBlade(visible, blade, state);
    const Found found = find(lens, drawn.ribbon,
                             Sighting(pixel + samplePlace(s), depth, pixel + middleOf(samples)));
    noteSeen(visible, drawn, found.place.y);
    const BladeSurface surface = bladeSurface(drawn, visible, layers);
    BladePoint point;
    point.position = pointSeen(lens, pixel + middleOf(samples), found.depth);
    point.place = found.place;
    point.tangent = tangentAt(drawn.ribbon, point.place.y);
    point.axis = drawn.ribbon.axis;
    point.up = normalize(drawn.ribbon.v1 - drawn.ribbon.v0);
    point.fold = drawn.ribbon.fold;
    point.rootColor = surface.root;
    point.tipColor = surface.tip;
    point.material = surface.material;
    return vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - point.position), 1.0));
}

/// What the film sees of the sky at a pixel.
vec4 skyAt(Lens lens, uvec2 pixel)
{
    const vec2 middle = vec2(pixel) + 0.5;
    return vec4(skyPicture(normalize(rayThrough(2.0 * middle / lens.size - 1.0)), middle), 1.0);
}
