#version 460
#extension GL_GOOGLE_include_directive : require
// A point of the blade: across its width axis (x) and along its curve (y).
#include "shaders/shared/bezier.h"
#include "shaders/shared/passes.h"

layout(quads, equal_spacing, ccw) in;
layout(push_constant, scalar) uniform Block { ViewPush push; };
#define FRAME push.frame.at[0]

layout(location = 0) patch in vec3 inV0;
layout(location = 1) patch in vec3 inV1;
layout(location = 2) patch in vec3 inV2;
layout(location = 3) patch in vec3 inAxis;
layout(location = 4) patch in vec4 inShape;
layout(location = 5) patch in vec4 inRootColor;
layout(location = 6) patch in vec4 inTipColor;
layout(location = 7) patch in vec4 inMaterial;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outTangent;
layout(location = 2) out vec3 outAxis;
layout(location = 3) out vec2 outPlace; // −1 … 1 across, 0 … 1 along
layout(location = 4) out vec4 outRootColor;
layout(location = 5) out vec4 outTipColor;
layout(location = 6) out vec4 outMaterial;
layout(location = 7) out vec3 outUp;

void main()
{
    const float u = gl_TessCoord.x;
    const float t = gl_TessCoord.y;
    const vec3 centre = bezierPoint(inV0, inV1, inV2, t);
    const vec3 tangent = bezierTangent(inV0, inV1, inV2, t);

    // Triangle-tip shape of the paper (section 4.2): full width up to the threshold, then a point.
    const float threshold = inShape.y;
    const float pointed = 1.0 - max(t - threshold, 0.0) / max(1.0 - threshold, 1e-3);
    const float taper = inShape.w > 1.5 ? pointed : mix(1.0, inShape.z, t);
    outPosition = centre + inAxis * (inShape.x * (u - 0.5) * taper);

    outTangent = normalize(dot(tangent, tangent) > 1e-18 ? tangent : inV1 - inV0);
    outAxis = inAxis;
    outPlace = vec2(2.0 * u - 1.0, t);
    outRootColor = inRootColor;
    outTipColor = inTipColor;
    outMaterial = inMaterial;
    outUp = normalize(inV1 - inV0);
    gl_Position = FRAME.viewProjection * vec4(outPosition, 1.0);
}
