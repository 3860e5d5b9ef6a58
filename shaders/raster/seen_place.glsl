// Finds the place of a blade that a sample shows, from the blade and the depth in the visibility.
#ifndef SWARD_RASTER_SEEN_PLACE_GLSL
#define SWARD_RASTER_SEEN_PLACE_GLSL

#include "shaders/raster/seen_triangle.glsl"
#include "shaders/common/view_ray.glsl"

/// A corner of a ribbon's triangle.
struct Corner {
    vec4 seen;
    vec2 place; ///< −1 … 1 across, 0 … 1 along
};

/// The visible point of a ribbon.
struct Found {
    vec3 point; ///< relative to the field's origin
    vec2 place; ///< as in Corner; slightly outside beside the rim
};

/// The best candidate so far for the visible point of a folded ribbon. Its depth determines its position in space:
/// storing the position of each corner would cost registers and thereby time.
struct Guess {
    float error; ///< 0: the sample lies in the triangle, at its depth
    float depth; ///< in the middle of the shaded samples
    vec2 place;  ///< as in Corner
};

/// Place and depth of a visible sample of a ribbon, and the middle of all samples shaded with it [pixels].
struct Sighting {
    vec2 pixel;
    float depth;
    vec2 middle;
};

/// A triangle with a smaller error is accepted. The rasteriser snaps corners to 1/256 of a pixel; this code does not.
const float foundError = 0.02;

/// Error of a triangle for a sample. The first term allows samples just outside by rounding; the second decides by
/// depth between triangles that both contain the sample.
float errorOf(SeenPoint seen, Sighting sighting)
{
    return max(-seen.least, 0.0) + abs(seen.depth / sighting.depth - 1.0);
}

/// Barycentric weights in the middle of the samples that are shaded with a sample.
vec3 sharesInMiddle(vec4 first, vec4 second, vec4 third, SeenPoint seen, Sighting sighting)
{
    const vec3 inside = max(samplesPerPixel == 1u ? seen.shares
                                                  : seenAt(first, second, third, sighting.middle).shares,
                            vec3(0.0));
    return inside / max(inside.x + inside.y + inside.z, 1e-6);
}

/// The reversed depth at these weights of a triangle's corners.
float depthOf(vec4 first, vec4 second, vec4 third, vec3 shares)
{
    return dot(shares, vec3(first.z, second.z, third.z)) / dot(shares, vec3(first.w, second.w, third.w));
}

/// Searches the surface between the cross-sections at `low` and `high` of a folded ribbon.
void lookAtHalves(Lens lens, Ribbon ribbon, float low, float high, bool isUpper, Sighting sighting,
                  inout Guess guess)
{
    const SeenSection before = seenSection(lens, ribbon, low);
    const SeenSection after = seenSection(lens, ribbon, high);
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
        if (error >= guess.error)
            continue;
        const vec3 shares = sharesInMiddle(first.seen, second.seen, third.seen, seen, sighting);
        guess.error = error;
        guess.depth = depthOf(first.seen, second.seen, third.seen, shares);
        guess.place = shares.x * first.place + shares.y * second.place + shares.z * third.place;
    }
}

/// A ribbon's curve relative to its root: the point at `t` is t · (toMiddle + t · bend).
struct Curve {
    vec3 toMiddle; ///< twice the vector to v1
    vec3 bend;
};

Curve curveOf(Ribbon ribbon)
{
    // `precise` rounds a ribbon from memory and a computed one equally: otherwise a compiler rearranges the latter's
    // terms.
    precise const vec3 toMiddle = 2.0 * (ribbon.v1 - ribbon.v0);
    precise const vec3 bend = ribbon.v2 - ribbon.v0 - toMiddle;
    return Curve(toMiddle, bend);
}

/// Unit direction of a curve at `t`, towards the tip: tangentAt() of its ribbon.
vec3 tangentOf(Curve curve, float t)
{
    const vec3 along = curve.toMiddle + (2.0 * t) * curve.bend;
    return normalize(dot(along, along) > 1e-18 ? along : curve.toMiddle);
}

/// Parameter of a point along a ribbon, accurate enough to find its segment. Viewed along the axis, which is
/// perpendicular to v1 − v0, a ribbon is a curve that contains the point. Gauss–Newton steps find the nearest curve
/// point, starting from the chord. Lengths are scaled by toMiddle.
float placeAlong(Ribbon ribbon, Curve curve, vec3 point)
{
    const vec3 upwards = curve.toMiddle;
    const vec3 forwards = cross(upwards, ribbon.axis);
    const vec3 toPoint = point - ribbon.v0;
    const float rise = dot(upwards, upwards);
    const vec2 bend = vec2(dot(curve.bend, upwards), dot(curve.bend, forwards));
    const vec2 tip = bend + vec2(rise, 0.0);
    const vec2 p = vec2(dot(toPoint, upwards), dot(toPoint, forwards));
    float t = clamp(dot(p, tip) / max(dot(tip, tip), 1e-30), 0.0, 1.0);
    [[dont_unroll]] for (uint i = 0u; i < 2u; ++i) {
        const vec2 half_ = vec2(rise, 0.0) + t * bend;
        const vec2 off = t * half_ - p;
        const vec2 speed = half_ + t * bend;
        t = clamp(t - dot(off, speed) / max(dot(speed, speed), 1e-30), 0.0, 1.0);
    }
    return t;
}

/// The direction through a place of the picture, not normalised.
vec3 rayTo(Lens lens, vec2 pixel)
{
    return rayThrough(2.0 * pixel / lens.size - 1.0);
}

/// The point at this reversed depth in the direction of a ray, relative to the field's origin.
vec3 pointSeen(Lens lens, vec3 ray, float depth)
{
    // Clip w is 0 at the eye and grows by 1 per length of the ray.
    const vec3 depthRow = vec3(lens.viewProjection[0].z, lens.viewProjection[1].z, lens.viewProjection[2].z);
    return lens.eye + (FRAME.depthOfEye / (depth - dot(depthRow, ray))) * ray;
}

/// The visible point of a folded ribbon. Searches the expected segment first, then its neighbours; otherwise takes the
/// best candidate of all.
Found findOnFold(Lens lens, Ribbon ribbon, Sighting sighting)
{
    Guess guess;
    guess.error = 1e30;
    const float segments = ribbon.outline.segments;
    const vec3 point = pointSeen(lens, rayTo(lens, sighting.pixel), sighting.depth);
    const float place = segments > 1.5 ? placeAlong(ribbon, curveOf(ribbon), point) : 0.0;
    float segment = clamp(floor(place * segments) + 1.0, 1.0, segments);
    // Offset to the next segment: the nearer neighbour first, then alternating.
    float step_ = fract(place * segments) < 0.5 ? -1.0 : 1.0;
    [[dont_unroll]] for (float turn = 0.0; turn < 2.0 * segments; turn += 1.0) {
        if (segment >= 1.0 && segment <= segments)
            lookAtHalves(lens, ribbon, (segment - 1.0) / segments, segment / segments,
                         upperHalf(segment, segments), sighting, guess);
        if (guess.error < foundError || segments < 1.5)
            break;
        segment += step_;
        step_ = -step_ - sign(step_);
    }
    return Found(pointSeen(lens, rayTo(lens, sighting.middle), guess.depth), guess.place);
}

/// Place of a point across a segment, −1 … 1, interpolated as by a tessellator in the one of its two triangles that
/// contains the point. `toLeft`, `toRight`: distances to the sides; `widths`: of the sections at its ends; `share`:
/// position between these.
float placeAcross(float toLeft, float toRight, vec2 widths, float share, bool isUpper)
{
    const bool isFirst = (isUpper ? toLeft : toRight) <= widths.x * (1.0 - share);
    const float width = max(isFirst ? widths.x : widths.y, 1e-6);
    return isFirst == isUpper ? 2.0 * toLeft / width - 1.0 : 1.0 - 2.0 * toRight / width;
}

/// The same without a fold: a segment is plane, between two cross-sections along the same axis. The depth determines
/// the segment; the place on the picture alone determines the point, as for a triangle.
Found findOnPlane(Lens lens, Ribbon ribbon, Sighting sighting)
{
    const float segments = ribbon.outline.segments;
    const vec3 point = pointSeen(lens, rayTo(lens, sighting.pixel), sighting.depth);
    const Curve curve = curveOf(ribbon);
    const float guess = placeAlong(ribbon, curve, point) * segments;
    const float segment = min(floor(guess), segments - 1.0);
    const float each = 1.0 / segments;
    const float low = segment * each;
    const float high = low + each;
    const vec3 begin = ribbon.v0 + low * (curve.toMiddle + low * curve.bend);
    const vec3 chord = each * (curve.toMiddle + (low + high) * curve.bend);
    const vec3 ray = rayTo(lens, sighting.middle);

    // Widen narrow sections across the view, as crossSectionAt() does.
    const vec3 side = cross(ray, chord);
    const float square = dot(side, side);
    const bool isAtEye = square <= 1e-12 * dot(ray, ray) * dot(chord, chord);
    vec3 across = isAtEye ? ribbon.axis : side * inversesqrt(square);
    const float seen = dot(ribbon.axis, across);
    across = seen < 0.0 ? -across : across;
    const vec2 first = ribbon.width * edgesAt(ribbon.outline, low);
    const vec2 second = ribbon.width * edgesAt(ribbon.outline, high);
    const vec2 ends = vec2(first.y - first.x, second.y - second.x);
    const vec2 wide = abs(seen) * ends;
    const vec2 drawn = max(wide, vec2(lens.minWidth * length(begin - lens.eye)));
    const vec2 grown = drawn - wide;
    vec3 axis = ribbon.axis;
    if (grown.x + grown.y > 0.0)
        axis = (ends.x + ends.y) * axis +
               (grown.x + grown.y) * outwardsOf(across, cross(ray, ribbon.v1 - ribbon.v0));

    // Intersect the ray with the plane of the segment, between the middles of its sections. The result does not depend
    // on the eye's distance.
    vec3 toEye = lens.eye - begin;
    vec3 upwards = chord;
    if (!isEven(ribbon.outline.shape)) {
        toEye -= (0.5 * (first.x + first.y)) * ribbon.axis;
        upwards += (0.5 * (second.x + second.y - first.x - first.y)) * ribbon.axis;
    }
    const vec3 turned = cross(ray, axis);
    const float steepness = dot(upwards, turned);
    const bool isLine = isAtEye || steepness == 0.0;
    const float share = clamp(isLine ? guess - segment : dot(toEye, turned) / steepness, 0.0, 1.0);
    const float reach = 0.5 * mix(drawn.x, drawn.y, share);
    const float off = dot(toEye - share * upwards, across);
    const float placeX = placeAcross(reach + off, reach - off, drawn, share,
                                      upperHalf(segment + 1.0, segments));
    return Found(pointSeen(lens, ray, sighting.depth), vec2(placeX, (segment + share) * each));
}

/// The point that a sample shows. On a flat blade it equals that of a tessellator's two triangles, except between
/// cross-sections that are drawn wider, which are not parallel.
Found find(Lens lens, Ribbon ribbon, Sighting sighting)
{
    if (isFolded(ribbon))
        return findOnFold(lens, ribbon, sighting);
    return findOnPlane(lens, ribbon, sighting);
}

#endif
