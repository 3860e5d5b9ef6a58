// What one blade's points have in common, on its way from the vertex to the fragment: in nine words,
// for each number that a tessellator's vertices carry is dear.
#ifndef SWARD_BLADE_PARCEL_GLSL
#define SWARD_BLADE_PARCEL_GLSL

struct BladeParcel {
    uvec4 surface; ///< colours in halves; open sky, translucency, gloss and the sun at the root in bytes
    uvec4 frame;   ///< leaf area and the sun at the tip; axis; up-vector; fold and bend
    uint bend;     ///< direction from v1 to v2
};

/// A unit vector in 32 bits, within 1e-4 rad.
uint packUnit(vec3 v)
{
    const vec2 flat_ = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
    const vec2 signs = vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(v.z >= 0.0 ? flat_ : (1.0 - abs(flat_.yx)) * signs);
}

vec3 unpackUnit(uint bits)
{
    const vec2 flat_ = unpackSnorm2x16(bits);
    const float z = 1.0 - abs(flat_.x) - abs(flat_.y);
    const vec2 signs = vec2(flat_.x >= 0.0 ? 1.0 : -1.0, flat_.y >= 0.0 ? 1.0 : -1.0);
    return normalize(vec3(z >= 0.0 ? flat_ : (1.0 - abs(flat_.yx)) * signs, z));
}

#endif
