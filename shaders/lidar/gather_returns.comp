#version 460
#extension GL_GOOGLE_include_directive : require
// Makes returns of the ends of rays, a thread for each beam, and packs them.
#include "shaders/shared/lidar/casting.h"

layout(local_size_x = lidarThreads) in;
layout(push_constant, scalar) uniform Block { LidarPush push; };

shared uint groupReturns;
shared uint groupFirst;
shared uint groupGround;
shared uint groupFree;

void main()
{
    const uint thread = gl_LocalInvocationIndex;
    if (thread == 0u) {
        groupReturns = 0u;
        groupGround = 0u;
        groupFree = 0u;
    }
    barrier();

    const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    const uint beam = group * lidarThreads + thread;
    const uint first = beam * push.sensor.rays;
    uint count = 0u;
    uint place = 0u;
    if (beam < push.beamCount) {
        uint ground = 0u;
        uint free = 0u;
        for (uint i = 0u; i < push.sensor.rays; ++i) {
            const LidarEnd end = push.ends.at[first + i];
            free += end.range == lidarMissed ? 1u : 0u;
            ground += end.range != lidarMissed && end.blade == lidarGround ? 1u : 0u;
        }
        count = countReturns(push.sensor, push.ends, first);
        place = atomicAdd(groupReturns, count);
        atomicAdd(groupGround, ground);
        atomicAdd(groupFree, free);
    }
    barrier();
    if (thread == 0u) {
        groupFirst = atomicAdd(push.totals.at[0].returns, groupReturns);
        atomicAdd(push.totals.at[0].groundRays, groupGround);
        atomicAdd(push.totals.at[0].freeRays, groupFree);
    }
    barrier();
    if (beam >= push.beamCount)
        return;
    place += groupFirst;
    push.runs.at[beam] = place | (count << lidarRunShift);
    float nearest = nextRange(push.sensor, push.ends, first, lidarBegin);
    for (uint i = 0u; i < count; ++i) {
        push.echoes.at[place + i] = echoAt(push.sensor, push.ends, first, nearest);
        nearest = nextRange(push.sensor, push.ends, first, nearest + push.sensor.resolution);
    }
}
