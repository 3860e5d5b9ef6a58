void main()
{
    gl_Position = vec4(gl_VertexIndex == 1u ? 3.0 : -1.0, gl_VertexIndex == 2u ? 3.0 : -1.0, 0.0, 1.0);
}
