// Shades what a visibility holds, each blade once per pixel, and averages. The including shader has
// groundAt() and the image `picture`.
#include "shaders/grass/blade_colors.glsl"
#include "shaders/grass/blade_light.glsl"
#include "shaders/raster/seen_triangle.glsl"
#include "shaders/shared/visibility.h"

#define JUDGED push.judged.at[0]

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

/// The blade with a resident id, as the list of visible blades had it.
VisibleBlade visibleBlade(uint blade)
{
    uint owner = push.firstOwners.at[blade / ownerStride];
    uint patchIndex = push.owners.at[owner];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.owners.at[++owner];
    const Patch cell = FRAME.patches.at[patchIndex];
    const Blade unpacked = unpackBlade(FRAME.blades.at[blade], cell);
    const float distance = length(unpacked.root - JUDGED.eye);
    const float share = shareAt(JUDGED.pixelsPerUnit, JUDGED.lodThreshold, JUDGED.lodWidth, distance);
    VisibleBlade visible;
    visible.blade = blade;
    visible.patchIndex = patchIndex;
    visible.widthFactor = lodWidthFactor(bladeRank(cell, blade - cell.firstBlade), share);
    visible.pixels = unpacked.height * JUDGED.pixelsPerUnit / max(distance, 1e-6);
    return visible;
}

/// The best guess so far at which point of a ribbon is seen.
struct Found {
    float error;
    vec3 position;
    vec3 tangent;
    vec2 place; ///< −1 … 1 across, 0 … 1 along
};

void look(vec3 a, vec3 b, vec3 c, vec4 seenA, vec4 seenB, vec4 seenC, vec2 placeA, vec2 placeB,
          vec2 placeC, vec3 tangentBefore, vec3 tangentAfter, vec2 alongs, vec2 pixel, float depth,
          inout Found found)
{
    const SeenPoint seen = seenAt(seenA, seenB, seenC, pixel);
    // A sample may lie just outside by rounding; between triangles that both hold it depth decides.
    const float error = max(-seen.least, 0.0) + abs(seen.depth / depth - 1.0);
    if (!(error < found.error))
        return;
    const vec3 shares = max(seen.shares, vec3(0.0)) / max(dot(max(seen.shares, vec3(0.0)), vec3(1.0)), 1e-6);
    found.error = error;
    found.position = shares.x * a + shares.y * b + shares.z * c;
    found.place = shares.x * placeA + shares.y * placeB + shares.z * placeC;
    const float t = (found.place.y - alongs.x) / (alongs.y - alongs.x);
    found.tangent = mix(tangentBefore, tangentAfter, t);
}

void lookQuad(Rib before, Rib after, vec3 a, vec3 b, vec3 c, vec3 d, vec2 across, vec2 alongs, vec2 pixel,
              float depth, inout Found found)
{
    const vec4 seenA = seenPoint(a);
    const vec4 seenB = seenPoint(b);
    const vec4 seenC = seenPoint(c);
    const vec4 seenD = seenPoint(d);
    const vec2 placeA = vec2(across.x, alongs.x);
    const vec2 placeB = vec2(across.y, alongs.x);
    const vec2 placeC = vec2(across.x, alongs.y);
    const vec2 placeD = vec2(across.y, alongs.y);
    look(a, b, d, seenA, seenB, seenD, placeA, placeB, placeD, before.tangent, after.tangent, alongs, pixel,
         depth, found);
    look(a, d, c, seenA, seenD, seenC, placeA, placeD, placeC, before.tangent, after.tangent, alongs, pixel,
         depth, found);
}

/// Which point of a ribbon is seen at `pixel` [pixels] and `depth`.
Found find(Ribbon ribbon, vec2 pixel, float depth)
{
    Found found;
    found.error = 1e30;
    found.position = ribbon.v0;
    found.tangent = ribbon.v1 - ribbon.v0;
    found.place = vec2(0.0);
    const float segments = ribbon.outline.segments;
    Rib before = ribAt(ribbon, 0.0, FRAME.eye, FRAME.leastWidth);
    for (float i = 1.0; i <= segments; i += 1.0) {
        const Rib after = ribAt(ribbon, i / segments, FRAME.eye, FRAME.leastWidth);
        const vec2 alongs = vec2(i - 1.0, i) / segments;
        if (ribbon.fold > 0.0) {
            lookQuad(before, after, before.left, before.ridge, after.left, after.ridge, vec2(-1.0, 0.0), alongs,
                     pixel, depth, found);
            lookQuad(before, after, before.ridge, before.right, after.ridge, after.right, vec2(0.0, 1.0), alongs,
                     pixel, depth, found);
        } else {
            lookQuad(before, after, before.left, before.right, after.left, after.right, vec2(-1.0, 1.0), alongs,
                     pixel, depth, found);
        }
        before = after;
    }
    return found;
}

vec3 shade(uint blade, vec2 pixel, float depth)
{
    const VisibleBlade visible = visibleBlade(blade);
    const DrawnBlade drawn = drawnBlade(visible);
    const BladeSurface surface = bladeSurface(drawn, visible);
    const Found found = find(drawn.ribbon, pixel, depth);
    BladePoint point;
    point.position = found.position;
    point.tangent = found.tangent;
    point.axis = drawn.ribbon.axis;
    point.up = normalize(drawn.ribbon.v1 - drawn.ribbon.v0);
    point.fold = drawn.ribbon.fold;
    point.place = found.place;
    point.rootColor = surface.root;
    point.tipColor = surface.tip;
    point.material = surface.material;
    return bladePicture(point);
}

vec3 encodeSrgb(vec3 c)
{
    return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main()
{
    const uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, push.size)))
        return;
    Visibility visibility = Visibility(uvec2(push.visibility));
    uint blades[4];
    float depths[4];
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        const uint64_t seen = visibility.at[sampleIndex(pixel, s)];
        blades[s] = uint(seen);
        depths[s] = uintBitsToFloat(uint(seen >> 32u));
    }

    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        if (blades[s] == 0u) {
            sum += groundAt(ivec2(pixel), int(s));
            continue;
        }
        // Shade a blade where the first of its samples stands for all of them.
        bool isFirst = true;
        for (uint other = 0u; other < s; ++other)
            isFirst = isFirst && blades[other] != blades[s];
        if (!isFirst)
            continue;
        float count = 0.0;
        for (uint other = s; other < samplesPerPixel; ++other)
            count += blades[other] == blades[s] ? 1.0 : 0.0;
        sum += count * shade(blades[s] - 1u, vec2(pixel) + samplePlace(s), depths[s]);
    }
    const vec3 color = encodeSrgb(sum / float(samplesPerPixel));
    imageStore(picture, ivec2(pixel), vec4(push.isBgr != 0u ? color.bgr : color, 1.0));
}
