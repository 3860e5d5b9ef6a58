// The ground beneath the grass, as drawn.
#ifndef SWARD_SHARED_GROUND_H
#define SWARD_SHARED_GROUND_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint noImage = 0xffffffffu;
SHARED_CONST uint groundDoubleSided = 1u;

struct GroundVertex {
    vec3 position; ///< [m] relative to the field's origin
    uint normal;   ///< octahedral, snorm16 × 2
    vec2 uv;       ///< (0, 0) at the image's upper left corner
    uint color;    ///< RGBA8, linear; white if the file has none or uses it as a mask
};
SHARED_LAYOUT(GroundVertex, 28)

struct GroundMaterial {
    vec4 baseColor;  ///< linear, multiplies image and vertex colour
    float roughness; ///< [0, 1]
    float metallic;  ///< [0, 1]
    uint image;      ///< index of the base colour image, or noImage
    uint flags;      ///< groundDoubleSided
};
SHARED_LAYOUT(GroundMaterial, 32)

/// Triangles of a cluster; the last cluster of a part of the ground may have fewer. The indices of
/// cluster `i` begin at index 3 · clusterTriangles · i.
SHARED_CONST uint clusterTriangles = 256u;

/// Neighbouring triangles of the ground, and their bounds.
struct GroundCluster {
    vec3 low; ///< [m] relative to the field's origin
    uint material;
    vec3 high;
    uint indexCount;
};
SHARED_LAYOUT(GroundCluster, 32)

/// VkDrawIndexedIndirectCommand.
struct IndexedDraw {
    uint indexCount;
    uint instanceCount;
    uint firstIndex;
    uint vertexOffset; ///< 0
    uint firstInstance;
};
SHARED_LAYOUT(IndexedDraw, 20)

SHARED_BUFFER(GroundClusterArray, GroundCluster, readonly)
SHARED_BUFFER(IndexedDrawArray, IndexedDraw, )
SHARED_BUFFER(GroundVertexArray, GroundVertex, readonly)
SHARED_BUFFER(GroundMaterialArray, GroundMaterial, readonly)

/// Direction from two snorm16 octahedral coordinates.
SHARED_FN vec3 decodeNormal32(uint bits)
{
    const float x = float((int(bits & 65535u) ^ 32768) - 32768) / 32767.0f;
    const float y = float((int(bits >> 16u) ^ 32768) - 32768) / 32767.0f;
    const float z = 1.0f - abs(x) - abs(y);
    const float fold = max(-z, 0.0f);
    return normalize(vec3(x + (x >= 0.0f ? -fold : fold), y + (y >= 0.0f ? -fold : fold), z));
}

SHARED_FN uint encodeNormal32(vec3 v)
{
    const float scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));
    float x = v.x * scale;
    float y = v.y * scale;
    if (v.z < 0.0f) {
        const float folded = (1.0f - abs(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - abs(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded;
    }
    const uint xi = uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;
    const uint yi = uint(int(floor(clamp(y, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;
    return xi | (yi << 16u);
}

SHARED_END
#endif
