#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// A view's cull result for a field: the visible patches found by the walk, and the list of blades
/// to be drawn.
class VisibleBlades {
public:
    /// Room for `roundPatches` visible patches in the list, and at most `maxBlades` blades. Further
    /// visible patches follow in later rounds.
    VisibleBlades(const gpu::DeviceContext& context, const BakedBlades& blades,
                  std::uint32_t roundPatches, std::uint32_t maxBlades);

    /// Writes addresses and the list's length into a frame.
    void describe(shared::Frame& frame) const;

    /// Follows an edit.
    void update(const gpu::DeviceContext& context, const BakedBlades& blades,
                OutgrownBuffers& outgrown);

    /// Clears the list, the counts, and the results of the walk.
    void clear(const gpu::Recording& commands) const;

    /// Maximum number of rounds, and visible patches per round.
    std::uint32_t roundCount() const { return roundCount_; }
    std::uint32_t roundPatches() const { return roundPatches_; }

    /// shared::WalkLevel of each round's list, then of its blades listed from the back.
    const gpu::Buffer& rounds() const { return rounds_; }

    VkDeviceAddress queue() const { return queue_.address(); } ///< of patches to be tested
    VkDeviceAddress visiblePatches() const
    {
        return visiblePatches_.address();
    }                                                     ///< shared::VisiblePatch
    const gpu::Buffer& levels() const { return levels_; } ///< shared::WalkLevel
    /// Index of the last level, for patches that colliders may touch. The walk's queue holds their
    /// list, once the walk has ended.
    std::uint32_t nearLevel() const { return nearLevel_; }
    /// shared::DrawArguments of the early list, then of the late one.
    const gpu::Buffer& draw() const { return draw_; }
    const gpu::Buffer& visible() const { return visible_; } ///< shared::VisibleBlade
    VkDeviceSize bytes() const { return bytes_; }

private:
    void fit(const gpu::DeviceContext& context, const BakedBlades& blades);
    gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes);

    std::uint32_t wantedPatches_ = 1; ///< of a round
    std::uint32_t maxBlades_ = 0;
    std::uint32_t roundPatches_ = 1;
    std::uint32_t roundCount_ = 1;
    std::uint32_t listLength_ = 0;
    std::uint32_t nearLevel_ = 0;
    VkDeviceSize bytes_ = 0;
    gpu::Buffer queue_;
    gpu::Buffer visiblePatches_;
    gpu::Buffer levels_;
    gpu::Buffer visible_;
    gpu::Buffer rounds_;
    gpu::Buffer draw_;
};

} // namespace sward::render
