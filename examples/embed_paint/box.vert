#version 450
// A cube from −1 to 1 in whatever place the host has for it, lit by the host's sun.
layout(push_constant) uniform Box { mat4 toClip; vec4 color; vec4 sun; };
layout(location = 0) out vec3 outColor;

void main()
{
    const int face = gl_VertexIndex / 6;
    const int corner = int[](0, 1, 2, 2, 1, 3)[gl_VertexIndex % 6];
    vec3 normal = vec3(0.0);
    normal[face % 3] = face < 3 ? 1.0 : -1.0;
    vec3 place = normal;
    place[(face + 1) % 3] = float(2 * (corner & 1) - 1);
    place[(face + 2) % 3] = float((corner & 2) - 1);
    gl_Position = toClip * vec4(place, 1.0);
    outColor = color.rgb * (0.35 + 0.65 * max(dot(normal, sun.xyz), 0.0));
}
