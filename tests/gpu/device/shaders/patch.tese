#version 460
#extension GL_EXT_scalar_block_layout : require

// One patch spans a square of the half-width `reach` around the middle of the picture.

layout(quads, equal_spacing, ccw) in;

layout(push_constant, scalar) uniform Push
{
    vec4 color;
    float reach;
    float depth;
};

void main()
{
    gl_Position = vec4((2.0 * gl_TessCoord.xy - 1.0) * reach, depth, 1.0);
}
