#pragma once

#include "apps/sward_view/scene/frame_options.h"
#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

namespace sward::view {

/// Render target of pictures without a window: on film, or linear radiance. Shaders store into it
/// only if they rasterise and the device supports it: otherwise storage usage would slow down the
/// graphics unit's writes.
gpu::ImageSettings targetFor(const gpu::DeviceContext& context, glm::uvec2 size,
                             render::Geometry geometry, bool isRadiance);

/// What such pictures are drawn with, one at a time: complete, whatever it takes.
render::FieldRendererSettings rendererFor(const FrameOptions& options, VkFormat format,
                                          bool isRadiance);

} // namespace sward::view
