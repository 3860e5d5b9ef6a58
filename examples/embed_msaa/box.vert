#version 450
// A cube from −1 to 1 in whatever place the host has for it, lit from above. Instance 0 is soil, others are red.
layout(push_constant) uniform Box { mat4 toClip; };
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
    const vec3 color = gl_InstanceIndex == 0 ? vec3(0.16, 0.11, 0.06) : vec3(0.6, 0.1, 0.08);
    outColor = color * (0.7 + 0.2 * normal.y + 0.1 * normal.x);
}
