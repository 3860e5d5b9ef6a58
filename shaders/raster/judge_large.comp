#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Finds those of the large blades that what has been drawn so far does not hide: what of the others is
// drawn is seen nowhere. Some threads look at one blade, segment by segment. A work-group that also
// draws would have most of its threads idle here.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"
#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/screen_rib.glsl"

layout(local_size_x = judgedTogether * judgeThreads) in;

shared uint isSeen[judgedTogether];
shared uint seenCount; // of those that are looked at together
shared uint firstPlace; // in the list of those that are seen
shared uint hiddenCount; // of all that the group has looked at

/// Whether all of the segment between two places on a ribbon is hidden.
bool segmentHidden(Lens lens, Ribbon ribbon, float from, float to)
{
    const SeenRib before = seenRib(lens, ribbon, from);
    const SeenRib after = seenRib(lens, ribbon, to);
    // What reaches through the near plane hides the rest.
    if (isCut(before) || isCut(after))
        return false;
    const ScreenRib a = screenRib(before, ribbon.fold > 0.0);
    const ScreenRib b = screenRib(after, ribbon.fold > 0.0);
    const vec3 low = min(min(min(a.left, a.right), a.ridge), min(min(b.left, b.right), b.ridge));
    const vec3 high = max(max(max(a.left, a.right), a.ridge), max(max(b.left, b.right), b.ridge));
    return rectangleHidden(low.xy, high.xy, high.z);
}

void main()
{
    LargePartArray large = push.large;
    const uint count = min(push.largeCount.at[0].count, mostLargeParts);
    const uint thread = gl_LocalInvocationIndex;
    const uint place = thread / judgeThreads;
    const Lens lens = lensOf();
    if (thread == 0u)
        hiddenCount = 0u;
    for (uint first = gl_WorkGroupID.x * judgedTogether; first < count;
         first += gl_NumWorkGroups.x * judgedTogether) {
        if (thread < judgedTogether)
            isSeen[thread] = 0u;
        if (thread == 0u)
            seenCount = 0u;
        barrier();

        const uint item = first + place;
        if (item < count && (large.at[item].part >> 16u) != 0u) {
            const Ribbon ribbon = ribbonOf(large.at[item]);
            const float segments = ribbon.outline.segments;
            bool isHidden = true;
            for (float i = float(thread % judgeThreads); i < segments && isHidden; i += float(judgeThreads))
                isHidden = segmentHidden(lens, ribbon, i / segments, (i + 1.0) / segments);
            if (!isHidden)
                atomicOr(isSeen[place], 1u);
        }
        barrier();

        // One thread for each blade: its place among those that are seen, or what is counted of it.
        const uint own = first + thread;
        const bool isOne = thread < judgedTogether && own < count && (large.at[own].part >> 16u) != 0u;
        const bool isListed = isOne && isSeen[thread] != 0u;
        uint slot = 0u;
        if (isListed)
            slot = atomicAdd(seenCount, 1u);
        else if (isOne && (large.at[own].part & 0xffffu) == 0u) {
            noteHidden(large.at[own].blade);
            atomicAdd(hiddenCount, 1u);
        }
        barrier();
        if (thread == 0u && seenCount > 0u) {
            WalkLevelArray counts = push.largeCount;
            firstPlace = atomicAdd(counts.at[2].count, seenCount);
            atomicMax(counts.at[2].groups[0], min(firstPlace + seenCount, mostGroups));
        }
        barrier();
        if (isListed) {
            UintArray seen = push.largeSeen;
            seen.at[firstPlace + slot] = own;
        }
    }
    barrier();
    if (thread == 0u)
        countHidden(hiddenCount);
}
