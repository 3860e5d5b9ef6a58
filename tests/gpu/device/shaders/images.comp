#version 460
#extension GL_EXT_scalar_block_layout : require

// stored[0] ← sampled[source], level by level.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D sampled[2];
layout(set = 0, binding = 1, r32f) uniform writeonly image2D stored[1];

layout(push_constant, scalar) uniform Push
{
    uint source;
    float level;
};

void main()
{
    const ivec2 size = imageSize(stored[0]);
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size)))
        return;
    const vec2 place = (vec2(pixel) + 0.5) / vec2(size);
    imageStore(stored[0], pixel, textureLod(sampled[source], place, level));
}
