#version 460
#extension GL_GOOGLE_include_directive : require
// One point of a blade in a depth-only pass: a blade drawn wider than it is covers fewer samples.
#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"

layout(push_constant, scalar) uniform Block { BladePush push; };

layout(location = 3) centroid in vec4 inPlace;
layout(location = 8) flat in uint inSeed;

void main()
{
    gl_SampleMask[0] = int(keptSamples(inPlace.z / max(inPlace.w, 1e-12), inSeed & 0xffffu,
                                       push.frame.at[0].view.samples));
}
