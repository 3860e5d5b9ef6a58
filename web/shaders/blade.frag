// One point of a ribbon: the light is that of all drawing paths of the viewer.
#include "web/shaders/frame.glsl"
#include "shaders/blade/blade_light.glsl"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/ribbon.h"
#include "web/shaders/middle.glsl"

in vec3 outPosition;
in vec4 outPlace;
flat in uvec4 outSurface;
flat in uvec4 outFrame;
flat in uvec3 outBend;

uniform uint samples;       // of a pixel that are drawn alone: 4, or 1
uniform uint sampleOfPixel; // that is drawn now

layout(location = 0) out vec4 outColor;

void main()
{
    // A ribbon that is drawn wider than it is keeps a share of its samples. WebGL cannot choose among the samples of a
    // pixel: unless each is drawn alone, the ribbon keeps or drops all of them, with the same mean.
    vec3 position = inMiddle(outPosition);
    vec2 place = inMiddle(outPlace.xy);
    // The middle lies beside the ribbon: few of the pixel's samples show it.
    if (abs(place.x) > 1.0 || place.y < 0.0 || place.y > 1.0) {
        position = outPosition;
        place = outPlace.xy;
    }
    const uint seed = outBend.z & 0xffffu;
    const uint kept = keptSamples(outPlace.z / max(outPlace.w, 1e-12), seed, samples);
    if (((kept >> sampleOfPixel) & 1u) == 0u)
        discard;
    const vec2 middle = unpackHalf2x16(outSurface.y);
    const vec4 bytes = unpackUnorm4x8(outSurface.w);
    const vec2 shade = unpackHalf2x16(outFrame.x);
    const vec2 bent = unpackHalf2x16(outFrame.w);
    const float along = clamp(place.y, 0.0, 1.0);
    BladePoint point;
    point.position = position;
    point.place = place;
    point.axis = decodeWideOctahedral(outFrame.y);
    point.up = decodeWideOctahedral(outFrame.z);
    point.fold = bent.x;
    point.tangent = normalize(mix(point.up, bent.y * decodeWideOctahedral(outBend.x), along));
    point.rootColor = vec4(unpackHalf2x16(outSurface.x), middle.x, bytes.w);
    point.tipColor = vec4(middle.y, unpackHalf2x16(outSurface.z), shade.y);
    point.look = bytes.xyz;
    point.leafAbove = leafAreaAbove(vec4(0.0, shade.x, float(outBend.y & 0xffffffu), 0.0), along);
    point.leafBelow = max(shade.x - point.leafAbove, 0.0);
    point.seed = seed;
    point.finish = float(outBend.z >> 16u);
    point.flecks = float(outBend.y >> 24u);
#ifdef IN_HOST
    outColor = vec4(forHost(bladePicture(point)), 1.0);
#else
    outColor = vec4(bladePicture(point), 1.0 - softness(length(FRAME.view.eye - position), 1.0));
#endif
}
