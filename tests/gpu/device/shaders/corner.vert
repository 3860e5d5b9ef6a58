#version 460
#extension GL_EXT_scalar_block_layout : require

// A right-angled triangle in the upper left corner: with reach 1 it covers half of the picture, with
// reach 3 all of it.

layout(push_constant, scalar) uniform Push
{
    vec4 color;
    float reach;
    float depth;
};

void main()
{
    const vec2 corner = vec2(gl_VertexIndex == 1 ? reach : -1.0, gl_VertexIndex == 2 ? reach : -1.0);
    gl_Position = vec4(corner, depth, 1.0);
}
