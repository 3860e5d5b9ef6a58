#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Which quarters of the blades a view has shown lately: a bit for each, see
/// shared::RasterPush::history. The early pass draws these quarters of large blades.
class VisibilityHistory {
public:
    VisibilityHistory() = default; ///< none: there is one pass

    /// Of blades with indices below `blades` (BakedBlades::indexCount()), initially empty.
    VisibilityHistory(const gpu::DeviceContext& context, std::uint32_t blades);

    VkDeviceAddress address() const { return bits_.address(); } ///< 0: none
    std::uint32_t frame() const { return frame_; } ///< number of frames begun: forgetsHistory()

    /// Begins a frame. Clears a new history; a transfer.
    void begin(const gpu::Recording& commands);

    /// Makes room for larger indices; the history is empty then. Returns the former buffer.
    gpu::Buffer grow(const gpu::DeviceContext& context, std::uint32_t blades);
    bool hasRoomFor(std::uint32_t blades) const; ///< also if there is no history

    VkDeviceSize bytes() const { return bits_.bytes(); }
    static VkDeviceSize bytesOf(std::uint32_t blades); ///< of a history of blades

private:
    gpu::Buffer bits_;
    bool isCleared_ = false;
    std::uint32_t frame_ = 0;
};

} // namespace sward::render
