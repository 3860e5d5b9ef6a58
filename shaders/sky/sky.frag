#version 460
#extension GL_GOOGLE_include_directive : require
// The sky with its sun.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/lighting.glsl"

layout(location = 0) in vec3 inRay;

layout(location = 0) out vec4 outColor;

void main()
{
    const vec3 ray = normalize(inRay);
    vec3 color = skyRadiance(ray);
    // The sun's disc is half a degree wide; its soft rim is drawn a little wider.
    const float toSun = dot(ray, FRAME.sunDirection);
    color += FRAME.sunColor * 6.0 * smoothstep(0.99985, 0.99997, toSun);
    if (FRAME.debugMode != 0u)
        color = vec3(0.6);
    outColor = vec4(dithered(develop(color), gl_FragCoord.xy), 1.0);
}
