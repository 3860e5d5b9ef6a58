#pragma once

#include "gpu/context.h"
#include "gpu/timestamps.h"
#include "render/geometry.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace sward::render {

/// Finds out on the frames as they come who draws large blades faster: some frames leave them to
/// compute shaders, as many to the tessellator. Their pictures are the same but for single samples
/// at edges. What other blades take is in both.
class GeometryTrial {
public:
    /// Frames drawn each way; the first of them, which may have to wait for memory, is not counted.
    static constexpr std::size_t framesEach = 5;

    /// The context's queue measures times.
    GeometryTrial(const gpu::DeviceContext& context, std::uint32_t slots);

    /// How a frame in `slot`, whose former commands have completed, is drawn: raster or hybrid.
    Geometry begin(VkCommandBuffer commands, std::uint32_t slot);

    /// Around what moves and draws the blades of the frame.
    void beginBlades(VkCommandBuffer commands);
    void endBlades(VkCommandBuffer commands);

    bool isDecided() const { return isDecided_; }
    const std::string& reason() const { return reason_; } ///< in words, with both times

private:
    void decide();

    gpu::Timestamps timestamps_;
    std::size_t frames_ = 0; ///< that have begun
    std::uint32_t scope_ = 0;
    bool isMeasured_ = false; ///< whether this frame is
    bool isDecided_ = false;
    Geometry geometry_ = Geometry::raster;
    std::string reason_ = "it is being measured";
};

} // namespace sward::render
