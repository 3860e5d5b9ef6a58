// The instances of fields in one view of a host. Their tables take the place of the push constants that the
// stages of a single field have.
#ifndef SWARD_RASTER_INSTANCES_GLSL
#define SWARD_RASTER_INSTANCES_GLSL

#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { HostViewPush host; };

RasterPush push; // of the instance that was chosen last

// The frame of a view's only instance comes as constants, which is quicker.
#ifdef ONE_INSTANCE
#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#else
#define FRAME push.frame.at[0]
#endif

/// Chooses all of an instance.
void chooseInstance(uint instance)
{
    push = host.instances.at[instance].raster;
    push.visibility = host.visibility;
    push.size = host.size;
}

/// Chooses nothing of it but what the visibility has for its blades.
void chooseFirstBlade(uint instance)
{
    push.firstBlade = host.instances.at[instance].raster.firstBlade;
}

/// Before the first choice: the lists are those of all instances.
void beginInstances()
{
    chooseInstance(0u);
}

/// The instance that has what the visibility shows: the last one that begins at `what` or before.
uint instanceOf(uint what)
{
    uint low = 0u;
    uint high = host.instanceCount;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (host.instances.at[middle].raster.firstBlade <= what)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#endif
