#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Casts the rays of a batch of beams, a thread each. The rays of a beam and its neighbours are neighbouring threads, which
// read the same nodes.
#include "shaders/shared/lidar/casting.h"

layout(local_size_x = lidarThreads) in;
layout(push_constant, scalar) uniform Block { LidarPush push; };

// Nodes and quads are read in four pieces of 16 bytes.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Quarters
{
    uvec4 at[];
};

RayNode nodeAt(uint i)
{
    Quarters quarters = Quarters(uvec2(push.tree.nodes));
    const vec4 a = uintBitsToFloat(quarters.at[4u * i]);
    const vec4 b = uintBitsToFloat(quarters.at[4u * i + 1u]);
    const vec4 c = uintBitsToFloat(quarters.at[4u * i + 2u]);
    const uvec4 d = quarters.at[4u * i + 3u];
    return RayNode(a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw, d.x, d.y, 0u, 0u);
}

RayQuad quadAt(uint i)
{
    Quarters quarters = Quarters(uvec2(push.tree.quads));
    const uvec4 a = quarters.at[4u * i];
    const uvec4 b = quarters.at[4u * i + 1u];
    const uvec4 c = quarters.at[4u * i + 2u];
    const uvec4 d = quarters.at[4u * i + 3u];
    return RayQuad(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), 0u,
                   uintBitsToFloat(d.xyz), 0u);
}

#define RAY_NODE(tree, i) nodeAt(i)
#define RAY_QUAD(tree, i) quadAt(i)
#include "shaders/shared/lidar/ray_search.h"

void main()
{
    const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    const uint i = group * lidarThreads + gl_LocalInvocationIndex;
    const uint rays = push.sensor.rays;
    if (i >= push.beamCount * rays)
        return;
    const uint beam = i / rays;
    const LidarRay cast_ = rayOfBeam(push.sensor, push.beams.at[beam], push.places.at[i - beam * rays]);
    const RaySpace ray = raySpace(cast_.from, cast_.towards);
    const RayFound found = searchRay(push.tree, ray);
    LidarEnd end = lidarMiss();
    if (found.quad != rayMisses) {
        const RayQuad quad = quadAt(found.quad);
        end = lidarEndAt(push.sensor, found.distance, cosineAt(ray, quad, found.isSecond), quad.blade,
                         push.reflectances.at[quad.surface]);
    }
    LidarEndTable ends = push.ends;
    ends.at[i] = end;
}
