#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "render/baked_blades.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// What one view finds of a field's blades: the visible patches on the way down the tree, and the
/// list of those blades that are to be drawn.
class VisibleBlades {
public:
    /// Room for `roundPatches` visible patches in the list, and for no more than `maxBlades`; live
    /// patches beyond take their turns in rounds.
    VisibleBlades(const gpu::DeviceContext& context, const BakedBlades& blades,
                  std::uint32_t roundPatches, std::uint32_t maxBlades);

    /// Writes addresses and the list's length into a frame.
    void describe(shared::Frame& frame) const;

    /// Empties the list, the counts, and what the walk has found.
    void clear(const gpu::Recording& commands) const;

    /// How often the visible patches fill the list at most, and by how many at a time.
    std::uint32_t roundCount() const { return roundCount_; }
    std::uint32_t roundPatches() const { return roundPatches_; }

    /// shared::WalkLevel of each round's list, then of what it has listed from behind.
    const gpu::Buffer& rounds() const { return rounds_; }

    VkDeviceAddress queue() const { return queue_.address(); } ///< of patches to be looked at
    VkDeviceAddress live() const { return live_.address(); }   ///< shared::VisiblePatch
    const gpu::Buffer& levels() const { return levels_; }      ///< shared::WalkLevel
    const gpu::Buffer& draw() const { return draw_; }          ///< shared::DrawArguments
    const gpu::Buffer& visible() const { return visible_; }    ///< shared::VisibleBlade
    VkDeviceSize bytes() const { return bytes_; }

private:
    gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes);

    std::uint32_t roundPatches_ = 1;
    std::uint32_t roundCount_ = 1;
    std::uint32_t listLength_ = 0;
    VkDeviceSize bytes_ = 0;
    gpu::Buffer queue_;
    gpu::Buffer live_;
    gpu::Buffer levels_;
    gpu::Buffer visible_;
    gpu::Buffer rounds_;
    gpu::Buffer draw_;
};

} // namespace sward::render
