#version 460
#extension GL_EXT_scalar_block_layout : require

layout(push_constant, scalar) uniform Push
{
    vec4 color;
    float reach;
    float depth;
};

layout(location = 0) out vec4 pixel;

void main()
{
    pixel = color;
}
