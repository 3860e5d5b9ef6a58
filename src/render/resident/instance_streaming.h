#pragma once

#include "gpu/recording/recording.h"
#include "render/frame/frame_stats.h"
#include "render/resident/placed_field.h"
#include "render/streaming/streaming.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Streams and sows the fields of a host's frame: pages and units are chosen by all views of all
/// instances of a field.
class InstanceStreaming {
public:
    /// Chooses pages for the frame written in `slot`, thins its instances to what is resident, and
    /// records the copies. Null instances are skipped. Needs a barrier from all accesses before;
    /// records one to compute shaders. Records nothing if no field is streamed or sown.
    /// `settledAt`: see settledTick().
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t settledAt,
                std::span<PlacedField* const> instances);

    /// Sums over the distinct fields of `instances`.
    StreamingStats stats(std::span<const PlacedField* const> instances);

private:
    void findFields(std::span<const PlacedField* const> instances);

    std::vector<const DeviceField*> fields_; ///< distinct, in the order of their first instances
    std::vector<shared::Eyepoint> seen_;
    std::vector<const BladeStates*> states_;
};

} // namespace sward::render
