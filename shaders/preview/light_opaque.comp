#version 460
#extension GL_GOOGLE_include_directive : require
// Lights opaque geometry where the visibility shows it. Stores the sum over the samples of a pixel that see it, divided
// by the number of all samples. Stores nothing where no sample sees it.
#include "shaders/shared/passes.h"
#include "shaders/shared/opaque.h"

layout(push_constant, scalar) uniform Block { OpaquePush push; };
layout(set = 0, binding = 0) uniform sampler2D baseColors[imagesTogether];
layout(set = 0, binding = 1, rgba16f) uniform image2D lit;

#define AFTER_BLADES
#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/preview/base_colors.glsl"
#include "shaders/preview/collider_light.glsl"
#include "shaders/preview/ground_light.glsl"
#include "shaders/resolve/half_rounded.glsl"
#include "shaders/preview/opaque_triangle.glsl"

const uint gatherTile = lightTile;
#include "shaders/resolve/gather.glsl"
#include "shaders/resolve/tile_classification.glsl"

layout(local_size_x = gatherThreads) in;

uint triangleAt(uvec2 pixel, uint s)
{
    return push.visibility.at[sampleIndex(pixel, s)].x;
}

/// Barycentric weights of a place of a triangle, and their change per pixel to the right and per pixel downwards.
struct Shares {
    vec3 here;
    vec3 right;
    vec3 down;
};

/// Triangles are lit at the middle of a pixel, or at the side nearest to it.
Shares sharesAt(OpaqueTriangle triangle, vec2 place)
{
    const vec3 areas = areasAt(triangle, place);
    const float sum = areas.x + areas.y + areas.z;
    const float whole = abs(sum) < 1e-30 ? 1e-30 : sum;
    const vec3 right = areasAt(triangle, place + vec2(1.0, 0.0)) - areas;
    const vec3 down = areasAt(triangle, place + vec2(0.0, 1.0)) - areas;
    Shares shares;
    shares.here = areas / whole;
    shares.right = (right - shares.here * (right.x + right.y + right.z)) / whole;
    shares.down = (down - shares.here * (down.x + down.y + down.z)) / whole;
    shares.here = max(shares.here, vec3(0.0));
    shares.here /= max(shares.here.x + shares.here.y + shares.here.z, 1e-30);
    return shares;
}

vec4 colliderLight(uint number, vec2 middle)
{
    const ColliderPoint a = colliderCorner(number, 0u);
    const ColliderPoint b = colliderCorner(number, 1u);
    const ColliderPoint c = colliderCorner(number, 2u);
    const vec3 shares = sharesAt(colliderTriangle(number), middle).here;
    return colliderPicture(mat3(a.position, b.position, c.position) * shares,
                           mat3(a.normal, b.normal, c.normal) * shares);
}

/// Whether this dispatch has the image of a material; then `texel` is the image's colour at a place.
bool findTexel(uint image, vec2 uv, vec2 right, vec2 down, out vec3 texel)
{
    const uint place = min(image, push.imageCount - 1u) - push.firstImage;
    texel = vec3(0.0);
    if (place >= imagesTogether)
        return false;
    texel = probedTexel(place, uv, right, down);
    return true;
}

vec4 groundLight(uint number, vec2 middle)
{
    const GroundMaterial material =
        push.materials.at[push.clusters.at[number / clusterTriangles].material];
    const uvec3 corners = cornersOf(number);
    const GroundVertex a = push.vertices.at[corners.x];
    const GroundVertex b = push.vertices.at[corners.y];
    const GroundVertex c = push.vertices.at[corners.z];
    const Shares shares = sharesAt(groundTriangle(number), middle);
    const mat3x2 uvs = mat3x2(a.uv, b.uv, c.uv);
    vec3 texel;
    if (!findTexel(material.image, uvs * shares.here, uvs * shares.right, uvs * shares.down, texel))
        return vec4(0.0);
    const vec3 tint = mat3(unpackUnorm4x8(a.color).rgb, unpackUnorm4x8(b.color).rgb,
                           unpackUnorm4x8(c.color).rgb) *
                      shares.here;
    GroundPoint point;
    point.position = mat3(a.position, b.position, c.position) * shares.here;
    point.normal = mat3(decodeNormal32(a.normal), decodeNormal32(b.normal), decodeNormal32(c.normal)) *
                   shares.here;
    point.albedo = material.baseColor.rgb * texel * tint;
    point.isDoubleSided = (material.flags & groundDoubleSided) != 0u;
    return groundPicture(point);
}

vec4 lightOf(uint number, vec2 middle)
{
    const uint ofGround = groundTriangles();
    if (number < ofGround)
        return groundLight(number, middle);
    return push.firstImage == 0u ? colliderLight(number - ofGround, middle) : vec4(0.0);
}

void main()
{
    uvec2 tile;
    if (!findTile(tile))
        return;
    const uint thread = gl_LocalInvocationIndex;
    const uvec2 pixel = pixelOf(tile, thread);
    if (thread == 0u)
        gatheredCount = 0u;
    barrier();

    uint leaders = 0u;
    if (all(lessThan(pixel, push.size))) {
        uint triangles[samplesPerPixel];
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
            triangles[s] = triangleAt(pixel, s);
        leaders = gatherTasks(thread, triangles, 1u, groundTriangles() + push.triangleCount + 1u);
    }
    barrier();

    for (uint i = thread; i < gatheredCount; i += gatherThreads) {
        const ShadingTask task = taskAt(i);
        const uvec2 place = pixelOf(tile, task.thread);
        putLight(task, lightOf(triangleAt(place, task.s) - 1u, vec2(place) + 0.5));
    }
    barrier();

    if (leaders == 0u)
        return;
    vec4 sum = sumOfLight(thread, leaders);
    if (push.firstImage > 0u)
        sum += imageLoad(lit, ivec2(pixel)) * float(samplesPerPixel);
    imageStore(lit, ivec2(pixel), halfRounded(sum / float(samplesPerPixel)));
}
