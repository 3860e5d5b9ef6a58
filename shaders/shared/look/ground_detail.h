// Bare ground near the eye: soil, stones, straw, and the ragged edge of what plants cover. All by
// formula, and all with the mean of the plain ground, so that it looks alike from afar.
#ifndef SWARD_SHARED_LOOK_GROUND_DETAIL_H
#define SWARD_SHARED_LOOK_GROUND_DETAIL_H

#include "shaders/shared/noise.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Bare ground at a place.
struct GroundDetail {
    vec3 albedo;      ///< linear; over the ground its mean is that of the ground
    float brightness; ///< factor of light in cracks and on crumbs; its mean is 1
    vec3 slope;       ///< derivative of the height; its mean is 0
};

/// Share of a structure of `size` [m] that pixels of `pixel` [m] show.
SHARED_FN float shownAt(float size, float pixel)
{
    return clamp(0.35f * size / pixel - 1.0f, 0.0f, 1.0f);
}

/// Sizes of crumbs, each this share of the one before.
SHARED_CONST uint crumbSizes = 5u;
SHARED_CONST float nextCrumb = 0.4f;

/// Mean and standard deviation of |2 v − 1| and of v, where v is valueNoise().
SHARED_CONST float meanCrumb = 0.3027f;
SHARED_CONST float noiseDeviation = 0.185f;

/// A rotation: level and upright ground cuts the turned lattice at all places of its cells alike.
SHARED_FN mat3 slantedLattice()
{
    return mat3(0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f);
}

/// Adds crumbs of soil with cracks between them, from `size` [m] down. `roughness` [0, 1].
SHARED_FN void addCrumbs(SHARED_INOUT(GroundDetail) detail, vec3 position, float size, float pixel,
                         float roughness)
{
    // The lattices of two sizes share no axis. They are bent, so that cracks are not straight.
    const mat3 turn = slantedLattice();
    float amount = 0.2f * roughness;
    for (uint i = 0u; i < crumbSizes; ++i) {
        const float shown = shownAt(size, pixel);
        if (shown <= 0.0f)
            break;
        const bool other = (i & 1u) != 0u;
        const vec3 place = position / size + 0.4f * detail.slope + 17.0f * float(i);
        const vec4 noise = valueNoiseSlope(other ? place * turn : turn * place);
        const vec3 rise = other ? turn * vec3(noise) : vec3(noise) * turn;
        const float height = 2.0f * noise.w - 1.0f;
        detail.brightness += amount * shown * (abs(height) - meanCrumb);
        detail.slope += (amount * shown * (height < 0.0f ? -1.0f : 1.0f)) * rise;
        size *= nextCrumb;
        amount = min(1.4f * amount, 0.38f * roughness);
    }
}

/// A number in [0, 1) from 8 bits of a hash.
SHARED_FN float byteOf(uint hash, uint i)
{
    return float((hash >> (8u * i)) & 255u) * (1.0f / 256.0f);
}

/// Share of the cells that have a stone, and its radius in edges of the cell. A stone lies at any
/// place of its cell where it fits, so that one look-up finds it.
SHARED_CONST float stoneChance = 0.4f;
SHARED_CONST float smallestStone = 0.08f;
SHARED_CONST float largestStone = 0.33f;

/// Share of any ground that cuts stones: their share of the space (Delesse 1847). The mean of r³ is
/// (b⁴ − a⁴) / (4 (b − a)).
SHARED_FN float stoneShare()
{
    const float low = smallestStone * smallestStone;
    const float high = largestStone * largestStone;
    const float meanCube = (high * high - low * low) / (4.0f * (largestStone - smallestStone));
    return stoneChance * 4.18879f * meanCube;
}

/// Lays one size of stones on ground whose mean colour is `mean`, updated with it. `edge` [m] of a
/// cell; `amount` [0, 1] of stones.
SHARED_FN void layStones(SHARED_INOUT(GroundDetail) detail, SHARED_INOUT(vec3) mean, vec3 rock,
                         vec3 position, float edge, float pixel, float amount)
{
    const float shown = amount * shownAt(0.4f * edge, pixel);
    if (shown <= 0.0f)
        return;
    mean = mix(mean, rock, shown * stoneShare());
    // Dents. They move all stones alike, so their share stays.
    const mat3 turn = slantedLattice();
    const vec3 place = turn * (position / edge + 0.1f * detail.slope);
    const vec3 cell = floor(place);
    const uint hash = mixUint(latticePoint(int(cell.x), int(cell.y), int(cell.z)) + 0x51ed270bu);
    if (float(hash >> 8u) * (1.0f / 16777216.0f) >= stoneChance)
        return;
    const uint more = mixUint(hash + 0x9e3779b9u);
    // Ellipsoids with the volume of a ball.
    const float first = 0.82f + 0.4f * byteOf(hash, 0u);
    const float second = 0.82f + 0.4f * byteOf(more, 0u);
    const vec3 radii = mix(smallestStone, largestStone, byteOf(mixUint(more), 0u)) *
                       vec3(first, 1.0f / (first * second), second);
    const vec3 middle =
        vec3(0.5f) + (vec3(1.0f) - 2.0f * radii) *
                         (vec3(byteOf(more, 1u), byteOf(more, 2u), byteOf(more, 3u)) - vec3(0.5f));
    const vec3 out_ = (place - cell - middle) / radii;
    const float soft = max(pixel / (edge * radii.x), 0.08f);
    const float seen = shown * clamp((1.0f - length(out_)) / soft + 0.5f, 0.0f, 1.0f);
    detail.albedo = mix(detail.albedo, (0.5f + byteOf(mixUint(more), 1u)) * rock, seen);
    detail.slope = mix(detail.slope, 0.4f * detail.slope - 0.8f * (out_ * turn), seen);
    detail.brightness = mix(detail.brightness, 1.0f, seen);
}

/// Straws: the mean share of the cells that have one, the mean of half its length and half its
/// width in edges of the cell, and layers of cells.
SHARED_CONST float strawChance = 0.4f;
SHARED_CONST float strawLength = 0.27f;
SHARED_CONST float strawWidth = 0.013f;
SHARED_CONST uint strawLayers = 3u;

/// Mean colour of straws, linear: weathered.
SHARED_CONST vec3 strawColor = vec3(0.21f, 0.165f, 0.095f);

/// Share of a line of 2 · `half_` that a pixel of `pixel` sees at `distance` from its middle.
SHARED_FN float lineSeen(float distance, float half_, float pixel)
{
    return clamp((distance + half_) / pixel + 0.5f, 0.0f, 1.0f) -
           clamp((distance - half_) / pixel + 0.5f, 0.0f, 1.0f);
}

/// Lays straws of a mean colour on ground whose mean colour is `mean`, updated with it. `place`:
/// along the ground, in edges of a cell; `edge` [m].
SHARED_FN void layStraws(SHARED_INOUT(GroundDetail) detail, SHARED_INOUT(vec3) mean, vec3 straw,
                         vec2 place, float edge, float pixel, float amount)
{
    const float shown = amount * shownAt(edge, pixel);
    if (shown <= 0.0f)
        return;
    const float width = max(pixel / edge, 0.3f * strawWidth);
    for (uint layer = 0u; layer < strawLayers; ++layer) {
        mean = mix(mean, straw, shown * strawChance * 4.0f * strawLength * strawWidth);
        // Layers are turned by an angle with the tangent 3/4, and moved.
        place = vec2(0.8f * place.x - 0.6f * place.y, 0.6f * place.x + 0.8f * place.y) +
                vec2(0.37f, 0.71f);
        const vec2 cell = floor(place);
        // Straws lie in drifts of some cells: the chance there is even from 0 to twice the mean.
        const vec2 drift = floor(0.25f * place);
        const uint many = mixUint(latticePoint(int(drift.x), int(drift.y), int(layer) + 7));
        const uint hash = mixUint(latticePoint(int(cell.x), int(cell.y), int(layer)));
        if (float(hash >> 8u) * (1.0f / 16777216.0f) >= 2.0f * strawChance * byteOf(many, 1u))
            continue;
        const uint more = mixUint(hash + 0x9e3779b9u);
        const float angle = 6.2831853f * byteOf(more, 0u);
        const vec2 along = vec2(cos(angle), sin(angle));
        const vec2 from = place - cell - vec2(0.5f);
        const float t = dot(from, along);
        // A straw is bent a little.
        const float beside = along.x * from.y - along.y * from.x +
                             (1.6f * byteOf(more, 1u) - 0.8f) * (t * t - 0.04f);
        const float length_ = strawLength * (0.4f + 1.2f * byteOf(more, 2u));
        const float seen =
            shown * lineSeen(beside, strawWidth, width) * lineSeen(t, length_, width);
        detail.albedo = mix(detail.albedo, (0.35f + 1.3f * byteOf(more, 3u)) * straw, seen);
    }
}

/// Size of damp and dry places, in largest crumbs.
SHARED_CONST float damp = 7.0f;

/// How far ground of colour `albedo` is green, [0, 1]: turf, which has no soil between its tufts.
SHARED_FN float turfIn(vec3 albedo)
{
    return smoothstep(1.15f, 1.6f, albedo.y / max(max(albedo.x, albedo.z), 1e-4f));
}

/// Bare ground of colour `albedo` at a `position`, with its unit `normal`. `up`: unit, away from
/// the ground below. `size` [m]: of the largest crumbs. Light ground is sand, chalk or snow, which
/// is smoother; stones and straws lie on slopes below 50°.
SHARED_FN GroundDetail groundDetail(vec3 position, vec3 normal, vec3 up, vec3 albedo, float size,
                                    float pixel)
{
    GroundDetail detail;
    detail.albedo = albedo;
    detail.brightness = 1.0f;
    detail.slope = vec3(0.0f);
    if (shownAt(damp * size, pixel) <= 0.0f)
        return detail;
    const float light = dot(albedo, vec3(0.2126f, 0.7152f, 0.0722f));
    const float soil = 1.0f - 0.75f * smoothstep(0.15f, 0.4f, light);
    // Damp and dry places.
    const float wide = damp * size;
    detail.brightness += 0.5f * soil * shownAt(wide, pixel) * (valueNoise(position / wide) - 0.5f);
    addCrumbs(detail, position, size, pixel, soil);

    const float lies = soil * (1.0f - turfIn(albedo)) * smoothstep(0.64f, 0.85f, dot(normal, up));
    vec3 mean = albedo;
    // Nothing that lies on dark ground is much lighter than it.
    const float dark = min(16.0f * light, 1.0f);
    const vec3 rock = mix(albedo, dark * vec3(0.14f, 0.13f, 0.115f), 0.5f);
    layStones(detail, mean, rock, position, 0.16f * size, pixel, lies);
    layStones(detail, mean, rock, position, 0.55f * size, pixel, lies);
    // Along the two axes that are nearest to the ground.
    const vec3 steep = abs(normal);
    const vec2 place = steep.y >= max(steep.x, steep.z) ? vec2(position.x, position.z)
                       : steep.x >= steep.z             ? vec2(position.y, position.z)
                                                        : vec2(position.x, position.y);
    layStraws(detail, mean, dark * strawColor, place / (0.5f * size), 0.5f * size, pixel, lies);
    detail.albedo = max(detail.albedo + albedo - mean, vec3(0.0f));
    return detail;
}

/// Whether undergrowth covers a place, as a share, where it covers the share `mean` of the ground
/// around, within 0.035. Tufts and gaps have ragged edges, from `cell` [m] down to a tenth of
/// `size` [m].
SHARED_FN float raggedShare(float mean, vec3 position, float cell, float size, float pixel)
{
    // A closed sward has no gaps. Some undergrowth is thin everywhere.
    const float amount = 0.75f * (1.0f - smoothstep(0.7f, 0.9f, mean));
    if (mean <= 0.0f || amount <= 0.0f)
        return mean;
    float step = max(0.5f * cell, size);
    const float whole = shownAt(step, pixel);
    float weight = whole;
    float sum = 0.0f;
    float squares = 0.0f;
    for (uint i = 0u; i < 4u && weight > 0.0f; ++i) {
        sum += weight * (valueNoise(position / step + 31.0f * float(i)) - 0.5f);
        squares += weight * weight;
        step = i == 0u ? 0.6f * size : 0.38f * step;
        weight = shownAt(step, pixel);
    }
    if (squares <= 0.0f)
        return mean;
    // The logistic function makes the sum, nearly normal, uniform in [0, 1].
    const float order = 1.0f / (1.0f + exp(-1.6f * sum / (noiseDeviation * sqrt(squares))));
    const float half_ = min(0.06f, 0.5f * min(mean, 1.0f - mean));
    const float covered = clamp(0.5f * (mean - order) / max(half_, 1e-6f) + 0.5f, 0.0f, 1.0f);
    return mix(mean, covered, amount * whole);
}

SHARED_END
#endif
