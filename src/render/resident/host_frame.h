#pragma once

#include "render/frame/frame.h"
#include "render/frame/placement.h"
#include "render/grass_frame.h"
#include "render/resident/instance_frame.h"

#include <cstdint>

namespace sward::render {

/// Where a field stands in a host's world, now and in the frame before.
struct PlacementOverTime {
    Placement now{};
    Placement before{};
};

/// A host's frame in the space of a field, without pyramids. Its `complete` may be called as long
/// as `frame`, `placement` and `field` live.
InstanceFrame inField(const GrassFrame& frame, const PlacementOverTime& placement,
                      const FieldShape& field, std::uint32_t number);

} // namespace sward::render
