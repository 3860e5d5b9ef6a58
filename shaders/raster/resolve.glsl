// Shades what a visibility holds, each blade once per pixel, and averages. The including shader has
// groundAt() and put().
#include "shaders/grass/blade_colors.glsl"
#include "shaders/grass/blade_light.glsl"
#include "shaders/raster/seen_triangle.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/sky/sky_light.glsl"

layout(local_size_x = rasterTile, local_size_y = rasterTile) in;

/// Index of the patch that owns a blade.
uint patchOf(uint blade)
{
    uint owner = push.firstOwners.at[blade / ownerStride];
    uint patchIndex = push.owners.at[owner];
    while (blade >= FRAME.patches.at[patchIndex].firstBlade + FRAME.patches.at[patchIndex].bladeCount)
        patchIndex = push.owners.at[++owner];
    return patchIndex;
}

/// A blade of patch `patchIndex`, as the list of visible blades had it.
VisibleBlade visibleBlade(uint index, uint patchIndex, Patch cell, Blade blade)
{
    const Eyepoint view = push.judged.at[0].view;
    const DrawnSize size = drawnSize(view, blade, bladeRank(cell, index - cell.firstBlade),
                                     length(blade.root - view.eye));
    return VisibleBlade(index, patchIndex, size.widthFactor, size.pixels);
}

/// A corner of a ribbon's triangle.
struct Corner {
    vec3 position;
    vec4 seen;
    vec2 place; ///< −1 … 1 across, 0 … 1 along
};

/// The best guess so far at which triangle of a ribbon is seen.
struct Found {
    float error;
    Corner a, b, c;
};

void look(Corner a, Corner b, Corner c, vec2 pixel, float depth, inout Found found)
{
    const SeenPoint seen = seenAt(a.seen, b.seen, c.seen, pixel);
    // A sample may lie just outside by rounding; between triangles that both hold it depth decides.
    const float error = max(-seen.least, 0.0) + abs(seen.depth / depth - 1.0);
    if (error < found.error)
        found = Found(error, a, b, c);
}

void lookQuad(Corner a, Corner b, Corner c, Corner d, bool isUpper, vec2 pixel, float depth, inout Found found)
{
    look(a, b, isUpper ? c : d, pixel, depth, found);
    look(isUpper ? b : a, d, c, pixel, depth, found);
}

/// Which point of a ribbon is seen at `pixel` [pixels] and `depth`.
Found find(Lens lens, Ribbon ribbon, vec2 pixel, float depth)
{
    Found found;
    found.error = 1e30;
    const float segments = ribbon.outline.segments;
    SeenRib before = seenRib(lens, ribbon, 0.0);
    for (float i = 1.0; i <= segments; i += 1.0) {
        const SeenRib after = seenRib(lens, ribbon, i / segments);
        const float low = (i - 1.0) / segments;
        const float high = i / segments;
        const bool isUpper = upperHalf(i, segments);
        const Corner a = Corner(before.rib.left, before.left, vec2(-1.0, low));
        const Corner b = Corner(before.rib.right, before.right, vec2(1.0, low));
        const Corner c = Corner(after.rib.left, after.left, vec2(-1.0, high));
        const Corner d = Corner(after.rib.right, after.right, vec2(1.0, high));
        if (ribbon.fold > 0.0) {
            const Corner e = Corner(before.rib.ridge, before.ridge, vec2(0.0, low));
            const Corner f = Corner(after.rib.ridge, after.ridge, vec2(0.0, high));
            lookQuad(a, e, c, f, isUpper, pixel, depth, found);
            lookQuad(e, b, f, d, isUpper, pixel, depth, found);
        } else {
            lookQuad(a, b, c, d, isUpper, pixel, depth, found);
        }
        before = after;
    }
    return found;
}

/// In the next frame the blade counts as one that was seen, if that is asked of it.
void noteSeen(VisibleBlade visible, Blade blade)
{
    if (uvec2(push.seen) == uvec2(0u) ||
        pixelsCovered(blade, visible.pixels, visible.widthFactor) <= largeBladePixels)
        return;
    UintArray seen = push.seen;
    const uint word = visible.blade / 32u;
    const uint bit = 1u << (visible.blade % 32u);
    if ((seen.at[word] & bit) == 0u)
        atomicOr(seen.at[word], bit);
}

/// What the film sees of a blade in the middle of the samples of a pixel, as bits, at which it is
/// seen, and 1 − softness. It lies at `depth` at one of them, `s`.
vec4 shade(Lens lens, uint index, vec2 pixel, uint samples, uint s, float depth)
{
    const uint patchIndex = patchOf(index);
    const Patch cell = FRAME.patches.at[patchIndex];
    const Blade blade = unpackBlade(FRAME.blades.at[placeOf(uvec2(FRAME.pages), index)], cell);
    const VisibleBlade visible = visibleBlade(index, patchIndex, cell, blade);
    noteSeen(visible, blade);
    const DrawnBlade drawn = drawnBlade(visible, blade);
    const BladeSurface surface = bladeSurface(drawn, visible);
    const Found found = find(lens, drawn.ribbon, pixel + samplePlace(s), depth);
    const SeenPoint seen = seenAt(found.a.seen, found.b.seen, found.c.seen, pixel + middleOf(samples));
    const vec3 inside = max(seen.shares, vec3(0.0));
    const vec3 shares = inside / max(inside.x + inside.y + inside.z, 1e-6);
    BladePoint point;
    point.position = shares.x * found.a.position + shares.y * found.b.position + shares.z * found.c.position;
    point.place = shares.x * found.a.place + shares.y * found.b.place + shares.z * found.c.place;
    point.tangent = tangentAt(drawn.ribbon, point.place.y);
    point.axis = drawn.ribbon.axis;
    point.up = normalize(drawn.ribbon.v1 - drawn.ribbon.v0);
    point.fold = drawn.ribbon.fold;
    point.rootColor = surface.root;
    point.tipColor = surface.tip;
    point.material = surface.material;
    return vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - point.position), 1.0));
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

    const Lens lens = lensOf();
    vec4 sum = vec4(0.0);
    float sky = 0.0;
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        if (blades[s] == 0u) {
            if (depths[s] > 0.0)
                sum += groundAt(ivec2(pixel), int(s));
            else
                sky += 1.0;
            continue;
        }
        // Once for all samples of a blade. They lie in the order of rows: the middle one is taken,
        // since the first would be nearer to the tip than what is seen.
        uint samples = 0u;
        for (uint other = 0u; other < samplesPerPixel; ++other)
            samples |= blades[other] == blades[s] ? 1u << other : 0u;
        const uint count = uint(bitCount(samples));
        if (uint(bitCount(samples & ((1u << s) - 1u))) != count / 2u)
            continue;
        sum += float(count) * shade(lens, blades[s] - 1u, vec2(pixel), samples, s, depths[s]);
    }
    if (sky > 0.0) {
        const vec2 middle = vec2(pixel) + 0.5;
        sum += sky * vec4(skyPicture(normalize(rayThrough(2.0 * middle / lens.size - 1.0)), middle), 1.0);
    }
    put(ivec2(pixel), sum / float(samplesPerPixel));
}
