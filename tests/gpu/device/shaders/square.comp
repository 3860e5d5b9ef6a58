#version 460
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require

// target[i] ← source[i]² + addend, over a grid of work groups that may be two-dimensional.

layout(local_size_x = 64) in;
layout(constant_id = 7) const uint addend = 0;

layout(buffer_reference, scalar) readonly buffer Source { uint at[]; };
layout(buffer_reference, scalar) writeonly buffer Target { uint at[]; };

layout(push_constant, scalar) uniform Push
{
    Source source;
    Target target;
    uint count;
};

void main()
{
    const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    const uint index = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (index >= count)
        return;
    const uint value = source.at[index];
    target.at[index] = value * value + addend;
}
