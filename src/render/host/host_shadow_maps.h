#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/memory.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/recording/recording.h"
#include "render/host/host_light.h"
#include "render/host/host_view.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Layout of a set with a host's shadow map, for the stages that light blades.
gpu::ImageSetLayout hostShadowLayout(const gpu::DeviceContext& context);

/// The shadow maps of the views of frames in flight, as descriptor sets. A view without a shadow
/// map has a small image in its place.
class HostShadowMaps {
public:
    HostShadowMaps(const gpu::DeviceContext& context, std::uint32_t slots, std::uint32_t maxViews);

    /// Begins a frame in a completed `slot`.
    void begin(std::uint32_t slot, const HostLight& light, std::span<const HostView> views);

    /// Makes the small image readable, if the frame uses it. Outside of a rendering.
    void record(const gpu::Recording& commands) const;

    /// Of a view of the frame last begun in `slot`.
    const gpu::ImageSet& of(std::uint32_t slot, std::uint32_t view) const;

    /// Whether that view has light of the host's.
    bool isLit(std::uint32_t slot, std::uint32_t view) const;

    const gpu::ImageSetLayout& layout() const { return layout_; }

private:
    /// A depth of one texel.
    struct Placeholder {
        gpu::Memory memory;
        gpu::Owned<VkImage, &gpu::DeviceFunctions::DestroyImage> image;
        gpu::ImageView view;
    };
    struct View {
        gpu::ImageSet set;
        bool isMade = false, isLit = false;
    };

    Placeholder makePlaceholder() const;

    const gpu::DeviceContext* context_;
    std::uint32_t maxViews_;
    gpu::ImageSetLayout layout_;
    gpu::Sampler sampler_;
    Placeholder placeholder_; ///< made on first use
    bool usesPlaceholder_ = false;
    std::vector<View> views_; ///< [slot][view]
};

/// Whether a view has light of the host's.
bool isLitByHost(const HostLight& light, const HostView& view);

} // namespace sward::render
