#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/field/visible_blades.h"
#include "render/preview/film_pass.h"
#include "render/preview/sky_pass.h"
#include "render/resolve/target_settings.h"
#include "render/tessellation/blade_pass.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <optional>

namespace sward::render {

/// The passes after the ground for tessellated blades: blades, sky, and reconstruction of
/// multisampled pictures.
class TessellatedPass {
public:
    TessellatedPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                    const TargetSettings& target);

    /// Call when the picture size has changed and the device is done with the old pictures.
    void resize(glm::uvec2 size);

    /// Makes the pipelines for a frame, with or without wind colours.
    void prepare(const gpu::ShaderLibrary& shaders, bool paintsWind);

    /// The resolve target of the rendering's samples; null with one sample per pixel.
    VkImageView begin(const gpu::Recording& commands) const;

    /// Inside a rendering, after the ground. `list`: null if there are no blades.
    void record(const gpu::Recording& commands, const VisibleBlades* list, VkDeviceAddress frame,
                gpu::Timestamps* timestamps) const;

    /// After the rendering: makes the target's picture from several samples.
    void finish(const gpu::Recording& commands, VkImageView target) const;

private:
    const gpu::DeviceContext* context_;
    TargetSettings target_;
    BladePass blades_;
    SkyPass sky_;
    std::optional<BladePass> windy_; ///< made on first use
    std::optional<FilmPass> film_;   ///< with several samples
    bool paintsWind_ = false;
};

} // namespace sward::render
