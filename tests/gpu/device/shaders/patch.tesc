#version 460

layout(vertices = 1) out;

void main()
{
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    gl_TessLevelOuter[0] = 3.0;
    gl_TessLevelOuter[1] = 3.0;
    gl_TessLevelOuter[2] = 3.0;
    gl_TessLevelOuter[3] = 3.0;
    gl_TessLevelInner[0] = 3.0;
    gl_TessLevelInner[1] = 3.0;
}
