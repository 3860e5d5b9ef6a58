#version 460
#extension GL_GOOGLE_include_directive : require
// The coarse levels of a depth pyramid; another dispatch has filled the finest levels.
#include "shaders/cull/coarse_levels.glsl"

layout(local_size_x = pyramidRestThreads) in;
layout(push_constant, scalar) uniform Block { ViewPush push; };

void main()
{
    putCoarseLevels(push.frame.at[0].pyramid, gl_LocalInvocationIndex, pyramidRestThreads);
}
