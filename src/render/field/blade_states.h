#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Bend of the blades of one placed field, and the time since when: the state between frames.
class BladeStates {
public:
    /// Optional storage besides the states themselves.
    struct Kept {
        bool before = false; ///< the states before the last move
        bool etas = false;   ///< collision state from the start; else see keepEtas()
    };

    BladeStates(const gpu::DeviceContext& context, const BakedBlades& blades, Kept kept);

    /// Writes addresses into a frame.
    void describe(shared::Frame& frame) const;

    /// Allocates collision state, initially none. Once.
    void keepEtas(const gpu::DeviceContext& context);
    bool hasEtas() const { return hasEtas_; }

    /// Puts every blade at rest, with `tick` as that of its last update, see tickOf().
    void rest(const gpu::Recording& commands, std::uint32_t tick) const;

    /// The same, but blades stay as they are.
    void settle(const gpu::Recording& commands, std::uint32_t tick) const;

    /// Makes room for the places of edited blades. New places have no state until one is written.
    void update(const gpu::DeviceContext& context, const BakedBlades& blades,
                OutgrownBuffers& outgrown);

    /// Resets the collision state of all blades.
    void clearEtas(const gpu::Recording& commands) const;

    const gpu::Buffer& states() const { return states_; } ///< shared::BladeState::turn
    const gpu::Buffer& etas() const { return etas_; }     ///< shared::BladeState::eta, if kept
    VkDeviceAddress patchTimes() const { return patchTimes_.address(); }
    VkDeviceAddress patchCounts() const { return patchCounts_.address(); }
    VkDeviceAddress before() const { return before_.address(); } ///< former turns, if kept
    VkDeviceSize bytes() const;

private:
    gpu::Buffer states_;
    gpu::Buffer etas_;
    bool hasEtas_ = false; ///< true also for a field without blades
    gpu::Buffer before_;
    bool keepsBefore_ = false; ///< likewise
    gpu::Buffer patchTimes_;
    gpu::Buffer patchCounts_;
};

} // namespace sward::render
