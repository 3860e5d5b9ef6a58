#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the layers of a frame from its visibility, before the picture is resolved and the visibility cleared; and the
// flow of the frame before to this one, for the places that the frame before has shown. With several samples per pixel,
// of the nearest one.
#include "shaders/shared/layers/layers_table.h"
#include "shaders/shared/opaque.h"

layout(push_constant, scalar) uniform Block { LayersPush layers; };
layout(set = 0, binding = 0) uniform sampler2D baseColors[imagesTogether];

RasterPush push; // of the frame

#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/layers/ground_layer.glsl"
#include "shaders/layers/shown.glsl"
#include "shaders/preview/collider_light.glsl"
#include "shaders/resolve/ribbon_motion.glsl"
#include "shaders/resolve/shade_found.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

Shown bladeShown(Lens lens, uint index, Sighting sighting)
{
    const SeenBlade seen = freshBlade(index);
    return shownOf(lens, seen, find(lens, seen.ribbon, sighting));
}

Shown groundShown(LayersTable table, Lens lens, uint triangle, Sighting sighting)
{
    const GroundCorners corners = groundCorners(table, triangle);
    const GroundMaterial material = table.materials.at[table.clusters.at[triangle / clusterTriangles].material];
    const vec3 ray = rayTo(lens, sighting.middle);
    Shown shown = skyShown(lens, sighting.middle);
    shown.kind = kindGround;
    shown.position = pointSeen(lens, ray, sighting.depth);
    shown.normal = groundNormal(corners, sharesInside(sharesAlong(corners, lens.eye, ray)), material.flags, ray);
    groundAlbedo(table, 0u, material, corners, lens, sighting.middle, shown.position, shown.albedo);
    if (isWanted(uvec2(table.shares)))
        shown.sun = sunOnGround(shown.position, shown.normal);
    return shown;
}

Shown colliderShown(Lens lens, uint number, Sighting sighting)
{
    Shown shown = skyShown(lens, sighting.middle);
    shown.kind = kindCollider;
    shown.number = number;
    shown.position = pointSeen(lens, rayTo(lens, sighting.middle), sighting.depth);
    const vec3 outwards = -towardsSegment(FRAME.environment.colliders.at[number], shown.position);
    shown.normal = outwards / max(length(outwards), 1e-9);
    shown.albedo = paint;
    shown.sun = sunSeen(FRAME.shadow, shown.position, shown.normal);
    return shown;
}

Shown shownAt(LayersTable table, Lens lens, uvec2 pixel, uint what, uint s, float depth)
{
    const vec2 middle = vec2(pixel) + samplePlace(s);
    const Sighting sighting = Sighting(middle, depth, middle);
    if (what == 0u)
        return skyShown(lens, middle);
    if (what >= push.firstBlade)
        return bladeShown(lens, what - push.firstBlade, sighting);
    const uint number = what - 1u;
    if (number < table.groundTriangles)
        return groundShown(table, lens, number, sighting);
    return colliderShown(lens, (number - table.groundTriangles) / colliderTriangles, sighting);
}

Moved movedBlade(Motion motion, Lens lens, uint index, vec2 place)
{
    Moved moved = Moved(vec4(0.0), vec4(0.0), false);
    if (uvec2(FRAME.pages) != uvec2(0u) && FRAME.pages.at[index / pageBlades] == noPlace)
        return moved;
    const SeenBlade seen = freshBlade(index);
    moved.now = vec4(pointAt(lens, seen.ribbon, place), 1.0);
    moved.before = vec4(pointAt(lens, ribbonBefore(motion, seen), place), 1.0);
    moved.isKnown = true;
    return moved;
}

/// `isBefore`: `position` is that of the frame before; else of this one.
Moved movedAt(LayersTable table, Motion motion, Lens lens, Shown shown, bool isBefore)
{
    if (shown.kind == kindBlade)
        return movedBlade(motion, lens, shown.number, shown.place);
    const vec4 at = vec4(shown.position, shown.kind == kindSky ? 0.0 : 1.0);
    Moved moved = Moved(at, at, true);
    if (shown.kind == kindCollider && shown.number < FRAME.environment.colliderCount) {
        const vec3 way = table.elapsed * FRAME.environment.colliders.at[shown.number].velocity;
        if (isBefore)
            moved.now.xyz += way;
        else
            moved.before.xyz -= way;
    }
    return moved;
}

vec2 flowOf(LayersTable table, Motion motion, Lens lens, Shown shown, bool isBefore)
{
    const Moved moved = movedAt(table, motion, lens, shown, isBefore);
    const vec4 before = motion.clipBefore * moved.before;
    const vec4 now = lens.viewProjection * moved.now;
    return isBefore ? wayBetween(moved, before, now) : wayBetween(moved, now, before);
}

void putPlace(UintArray places, uint index, Shown shown)
{
    const uint first = placeWords * index;
    const bool isBlade = shown.kind == kindBlade;
    places.at[first] = shown.kind | (isBlade ? 0u : shown.number << 2u);
    places.at[first + 1u] = isBlade ? shown.number : floatBitsToUint(shown.position.x);
    places.at[first + 2u] = floatBitsToUint(isBlade ? shown.place.x : shown.position.y);
    places.at[first + 3u] = floatBitsToUint(isBlade ? shown.place.y : shown.position.z);
}

Shown placeBefore(UintArray places, uint index, Lens lens)
{
    const uint first = placeWords * index;
    const uvec4 words = uvec4(places.at[first], places.at[first + 1u], places.at[first + 2u], places.at[first + 3u]);
    Shown shown = skyShown(lens, vec2(0.0));
    shown.kind = words.x & 3u;
    shown.number = shown.kind == kindBlade ? words.y : words.x >> 2u;
    shown.position = uintBitsToFloat(words.yzw);
    shown.place = uintBitsToFloat(words.zw);
    return shown;
}

void main()
{
    LayersTableArray tables = layers.table;
    LayersTable table = tables.at[0];
    push = layers.raster.at[0];
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size)))
        return;
    const Lens lens = lensOf();
    const uint index = pixel.y * push.size.x + pixel.x;

    uint what = 0u;
    uint nearest = 0u;
    uint depth = 0u;
    uint covered = 0u;
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        const uvec2 word = push.visibility.at[sampleIndex(pixel, s)];
        covered += word.x >= push.firstBlade ? 1u : 0u;
        // Depths are not negative: their bits are ordered as they are.
        if (word.x != 0u && word.y >= depth) {
            what = word.x;
            depth = word.y;
            nearest = s;
        }
    }
    if (layers.firstImage > 0u) {
        // The other images of the ground.
        if (what == 0u || what > table.groundTriangles || !isWanted(uvec2(table.albedos)))
            return;
        const vec2 middle = vec2(pixel) + samplePlace(nearest);
        const vec3 position = pointSeen(lens, rayTo(lens, middle), uintBitsToFloat(depth));
        const GroundMaterial material = table.materials.at[table.clusters.at[(what - 1u) / clusterTriangles].material];
        vec3 albedo;
        if (groundAlbedo(table, layers.firstImage, material, groundCorners(table, what - 1u), lens, middle, position,
                         albedo))
            putHalves(table.albedos, index, albedo);
        return;
    }
    const Shown shown = shownAt(table, lens, pixel, what, nearest, uintBitsToFloat(depth));
    putShown(table, lens, index, shown, float(covered) / float(samplesPerPixel), 1.0);
    if (isWanted(uvec2(table.places)))
        putPlace(table.places, index, shown);
    if (!isWanted(uvec2(table.flows)) && !isWanted(uvec2(table.flowsAhead)))
        return;
    MotionArray motions = table.motion;
    Motion motion = motions.at[0];
    if (isWanted(uvec2(table.flows)))
        putFlow(table.flows, index, flowOf(table, motion, lens, shown, false));
    if (isWanted(uvec2(table.flowsAhead)) && isWanted(uvec2(table.placesBefore)))
        putFlow(table.flowsAhead, index, flowOf(table, motion, lens, placeBefore(table.placesBefore, index, lens), true));
}
