// The instances of fields in one view of a host. Their tables replace the push constants of the stages of a single
// field.
#ifndef SWARD_RASTER_INSTANCES_GLSL
#define SWARD_RASTER_INSTANCES_GLSL

#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { HostViewPush host; };

RasterPush push; // of the chosen instance

// The frame of a view's only instance is read as constants, which is faster.
#ifndef HAS_INSTANCES
#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#else
#define FRAME push.frame.at[0]
#endif

/// Selects all data of an instance.
void chooseInstance(uint instance)
{
    push = host.instances.at[instance].raster;
    push.visibility = host.visibility;
    push.size = host.size;
}

/// Selects only the instance's first blade in the visibility.
void chooseFirstBlade(uint instance)
{
    push.firstBlade = host.instances.at[instance].raster.firstBlade;
}

/// Called before the first selection: the lists are shared by all instances.
void beginInstances()
{
    chooseInstance(0u);
}

/// The instance of a visibility value: the last one whose firstBlade is at most `what`.
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
