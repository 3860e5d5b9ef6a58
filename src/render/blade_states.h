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
    /// What is kept besides the states themselves.
    struct Kept {
        bool before = false; ///< the states from which blades were last moved
        bool etas = false;   ///< what collisions leave, from the beginning; else see keepEtas()
    };

    BladeStates(const gpu::DeviceContext& context, const BakedBlades& blades, Kept kept);

    /// Writes addresses into a frame.
    void describe(shared::Frame& frame) const;

    /// Keeps what collisions leave from now on, none at first. Allocates, once.
    void keepEtas(const gpu::DeviceContext& context);
    bool hasEtas() const { return hasEtas_; }

    /// Puts every blade at rest, last moved at `time` [s].
    void rest(const gpu::Recording& commands, float time) const;

    /// Nobody has been touched by a collider.
    void clearEtas(const gpu::Recording& commands) const;

    const gpu::Buffer& states() const { return states_; } ///< shared::BladeState::turn
    const gpu::Buffer& etas() const { return etas_; }     ///< shared::BladeState::eta, if kept
    VkDeviceAddress patchTimes() const { return patchTimes_.address(); }
    VkDeviceAddress patchCounts() const { return patchCounts_.address(); }
    VkDeviceAddress before() const { return before_.address(); } ///< the same, if they are kept
    VkDeviceSize bytes() const;

private:
    gpu::Buffer states_;
    gpu::Buffer etas_;
    bool hasEtas_ = false; ///< also of no blades
    gpu::Buffer before_;
    gpu::Buffer patchTimes_;
    gpu::Buffer patchCounts_;
};

} // namespace sward::render
