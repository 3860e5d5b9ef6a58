// One point of a blade that the rasteriser has found.
#include "shaders/shared/passes.h"

#ifdef HAS_MOTION
layout(push_constant, scalar) uniform Block { MotionPush push; };
#else
layout(push_constant, scalar) uniform Block { ViewPush push; };
#endif

#include "shaders/grass/blade_light.glsl"
#include "shaders/shared/ribbon.h"

layout(location = 0) centroid in vec3 inPosition;
layout(location = 1) centroid in vec3 inTangent;
layout(location = 2) centroid in vec3 inAxis;
layout(location = 3) centroid in vec4 inPlace;
layout(location = 4) centroid in vec4 inRootColor;
layout(location = 5) centroid in vec4 inTipColor;
layout(location = 6) centroid in vec4 inMaterial;
layout(location = 7) centroid in vec4 inUp;
layout(location = 8) flat in uint inBlade;

layout(location = 0) out vec4 outColor;
#ifdef HAS_MOTION
layout(location = 9) centroid in vec4 inClip;
layout(location = 10) centroid in vec4 inClipBefore;
layout(location = 1) out vec2 outMotion; // where it was minus where it is, in widths and heights
#endif

void main()
{
    const uint kept = keptSamples(inPlace.z / max(inPlace.w, 1e-12), inBlade, FRAME.view.samples);
    gl_SampleMask[0] = int(kept);
    BladePoint point;
    point.position = inPosition;
    point.tangent = inTangent;
    point.axis = inAxis;
    point.up = inUp.xyz;
    point.fold = inUp.w;
    point.place = inPlace.xy;
    point.rootColor = inRootColor;
    point.tipColor = inTipColor;
    point.material = inMaterial;
    const float soft = handedTo == handedToFilm ? softness(length(FRAME.view.eye - inPosition), 1.0) : 0.0;
    outColor = vec4(bladePicture(point), 1.0 - soft);
#ifdef HAS_MOTION
    outMotion = 0.5 * (inClipBefore.xy / inClipBefore.w - inClip.xy / inClip.w);
#endif
}
