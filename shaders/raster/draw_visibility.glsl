// Draws into a host's rendering what the visibility shows: a blade is lit where it is seen, sample by sample,
// and has its own depth. The including stage defines `place`, 0 … 1 in the picture, where the fragment is.
#include "shaders/raster/instances.glsl"
#include "shaders/raster/shade_found.glsl"

#ifdef HAS_MOTION
#include "shaders/grass/rib_point.glsl"
#endif

layout(location = 0) out vec4 outColor;
#ifdef HAS_MOTION
layout(location = 1) out vec2 outMotion; // where it was minus where it is, in widths and heights
#endif

/// Whether depths are 0 near and 1 far; known when the pipeline is made.
layout(constant_id = 16) const bool hasForwardZ = false;

#ifdef HAS_MOTION
/// The ribbon before this frame has moved it.
Ribbon ribbonBefore(Motion motion, SeenBlade seen)
{
    Ribbon ribbon = seen.ribbon;
    if (motion.moves == 0u || FRAME.patchTimes.at[seen.patchIndex] != FRAME.time)
        return ribbon;
    const Patch cell = FRAME.patches.at[seen.patchIndex];
    const Blade blade = raised(unpackBlade(FRAME.blades.at[seen.blade], cell),
                               layersOf(push.judged.at[0].view, cell).rise);
    const BladeState before = BladeState(motion.statesBefore.at[seen.blade], 0.0);
    const Pose pose = poseOfState(axesAlong(blade.up, ribbon.axis), before);
    ribbon.v1 = blade.root + blade.height * pose.v1;
    ribbon.v2 = blade.root + blade.height * pose.v2;
    return ribbon;
}

/// A place of a ribbon as it is drawn: between the ribs at the ends of its segment.
vec3 pointAt(Lens lens, Ribbon ribbon, vec2 place)
{
    const float segments = ribbon.outline.segments;
    const float along = clamp(place.y, 0.0, 1.0) * segments;
    const float first = min(floor(along), segments - 1.0);
    const float across = clamp(0.5 * place.x + 0.5, 0.0, 1.0);
    return mix(onRib(ribAt(ribbon, first / segments, lens.eye, lens.minWidth), across),
               onRib(ribAt(ribbon, (first + 1.0) / segments, lens.eye, lens.minWidth), across), along - first);
}

vec2 motionOf(Motion motion, Lens lens, SeenBlade seen, Found found)
{
    const vec4 before = motion.clipBefore * vec4(pointAt(lens, ribbonBefore(motion, seen), found.place), 1.0);
    const vec4 now = lens.viewProjection * vec4(pointAt(lens, seen.ribbon, found.place), 1.0);
    return 0.5 * (before.xy / before.w - now.xy / now.w);
}
#endif

/// Which sample of its pixel lies at a place: they lie in rows of their own.
uint sampleAt(vec2 pixel)
{
    return samplesPerPixel == 1u ? 0u : min(uint(fract(pixel.y) * 4.0), 3u);
}

/// Lights what the visibility shows of a blade at a sample, `what` and how deep.
void drawBlade(vec2 place, uint what, float depth)
{
    const uint instance = instanceOf(what);
    chooseInstance(instance);
    const Lens lens = lensOf();
    const SeenBlade seen = freshBlade(what - push.firstBlade);
    const Found found = find(lens, seen.ribbon, Sighting(place, depth, place));
    outColor = shadeFound(seen, found);
    if (handedTo != handedToHostFilm)
        outColor.a = 1.0;
#ifdef HAS_MOTION
    outMotion = motionOf(host.instances.at[instance].motion.at[0], lens, seen, found);
#endif
}

void drawPlace(vec2 place)
{
    push.size = host.size;
    const vec2 at = place * vec2(host.size);
    const uvec2 pixel = min(uvec2(at), host.size - 1u);
    const uint s = sampleAt(at);
    Visibility visibility = Visibility(uvec2(host.visibility));
    const uint64_t word = visibility.at[sampleIndex(pixel, s)];
    const uint what = uint(word);
    const float depth = uintBitsToFloat(uint(word >> 32u));
    gl_FragDepth = hasForwardZ ? 1.0 - depth : depth;
    outColor = vec4(0.0);
#ifdef HAS_MOTION
    outMotion = vec2(0.0);
#endif
    // Within a condition, since llvmpipe goes on with what has been discarded: nothing has no patch.
    if (what == 0u)
        discard;
    else if (handedTo != handedToNobody)
        drawBlade(vec2(pixel) + samplePlace(s), what, depth);
}
