#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "render/baked_blades.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// How the blades of one field in one place are bent, and since when: what moves between frames.
class BladeStates {
public:
    /// `keepsBefore`: also the states from which blades were last moved.
    BladeStates(const gpu::DeviceContext& context, const BakedBlades& blades,
                bool keepsBefore = false);

    /// Writes addresses into a frame.
    void describe(shared::Frame& frame) const;

    /// Puts every blade at rest, last moved at `time` [s].
    void rest(const gpu::Recording& commands, float time) const;

    const gpu::Buffer& states() const { return states_; } ///< shared::BladeState
    VkDeviceAddress patchTimes() const { return patchTimes_.address(); }
    VkDeviceAddress patchCounts() const { return patchCounts_.address(); }
    VkDeviceAddress before() const { return before_.address(); } ///< the same, if they are kept
    VkDeviceSize bytes() const;

private:
    gpu::Buffer states_;
    gpu::Buffer before_;
    gpu::Buffer patchTimes_;
    gpu::Buffer patchCounts_;
};

} // namespace sward::render
