#version 460
#extension GL_GOOGLE_include_directive : require
// Copies a buffer. Measures the read and write bandwidth of a device.
#include "shaders/shared/passes.h"

layout(local_size_x = copyThreads) in;
layout(push_constant, scalar) uniform Block { CopyPush push; };

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Quadruple
{
    uvec4 at[];
};

void main()
{
    Quadruple from = Quadruple(uvec2(push.from));
    Quadruple to = Quadruple(uvec2(push.to));
    const uint stride = gl_NumWorkGroups.x * copyThreads;
    for (uint i = gl_GlobalInvocationID.x; i < push.count; i += stride)
        to.at[i] = from.at[i];
}
