// Varyings that are constant over a blade, from the vertex to the fragment stage. Packed into ten words, because each
// varying of a tessellator's vertices is expensive.
#ifndef SWARD_TESSELLATION_BLADE_VARYINGS_GLSL
#define SWARD_TESSELLATION_BLADE_VARYINGS_GLSL

struct BladeVaryings {
    uvec4 surface; ///< colours in halves; open sky, translucency, gloss and the sun at the root in bytes
    uvec4 frame;   ///< leaf area and the sun at the tip; axis; up-vector; fold and bend
    uvec2 bend;    ///< direction from v1 to v2; packedHeights() as 24 bits, and the number of flecks along it
};

#endif
