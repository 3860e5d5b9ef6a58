#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/field_looks.h"
#include "render/field/visible_blades.h"
#include "render/frame/frame_place.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace sward::render {

class PlacedField;

/// Draws the blades near the eye of each view as the sun sees them: shared::BladeShadow.
class BladeShadowPass {
public:
    BladeShadowPass(const gpu::DeviceContext& context, std::uint32_t maxViews);

    /// Specialisation of the shader.
    struct Variant {
        bool isPaged = false; ///< some blades may not be in memory
        FieldLooks looks{};
        auto operator<=>(const Variant&) const = default;
    };

    static Variant variantOf(const PlacedField& field);

    /// Whether the device can: it has 64-bit atomics on buffers.
    bool isPossible() const { return context_->features.bufferInt64Atomics; }

    /// Makes the map of a view on first use; returns its address.
    VkDeviceAddress expectMap(std::uint32_t view);

    void prepare(const gpu::ShaderLibrary& shaders, const Variant& variant);

    /// Clears the map of a view: a transfer.
    void clear(const gpu::Recording& commands, std::uint32_t view) const;

    /// Draws the blades of one instance. `found`: the patches that the walk of the sun's view has
    /// found; `frame`: of that view. `variant` must be prepared. Needs barriers from the walk, from
    /// the motion of blades and from the clearing before, and to shaders after.
    void record(const gpu::Recording& commands, std::uint32_t view, const Variant& variant,
                const VisibleBlades& found, const FramePlace& frame) const;

    VkDeviceSize bytes() const;

    /// Of the map of a view, and of its list for a field of so many patches; an upper bound.
    static VkDeviceSize bytesFor(std::size_t patches);

private:
    const gpu::DeviceContext* context_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
    std::vector<gpu::Buffer> maps_; ///< by view; empty until expectMap()
};

} // namespace sward::render
