#pragma once

#include "gpu/context.h"
#include "gpu/rendering.h"
#include "gpu/shader_library.h"
#include "gpu/timestamps.h"
#include "render/attachments.h"
#include "render/depth_pyramid.h"
#include "render/field_renderer.h"
#include "render/frame.h"
#include "render/frame_slot.h"
#include "render/grass_cover.h"
#include "render/memory_plan.h"
#include "render/moving_blades.h"
#include "render/opaque_pass.h"
#include "render/opaque_raster_pass.h"
#include "render/raster_rounds.h"
#include "render/resolve_pass.h"
#include "render/streaming.h"
#include "render/sun_shadow.h"
#include "render/target_settings.h"
#include "render/tessellated_pass.h"

#include <optional>
#include <vector>

namespace sward::render {

/// What a field's renderer consists of, and how its frames are put together.
struct FieldRenderer::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field,
          const Settings& wanted);

    const gpu::DeviceContext& context;
    Settings settings;
    Geometry geometry; ///< never automatic
    gpu::ShaderLibrary shaders;
    TargetSettings targetSettings;
    GroundBuffers ground;
    GrassCover cover;
    SunShadowPass sunShadow;
    DepthPyramid pyramid;
    glm::uvec2 pictureSize{0}; ///< [pixels] of the pictures that are there

    // By the geometry the graphics pipeline …
    std::optional<Attachments> attachments;
    std::optional<OpaquePass> opaque;
    std::optional<TessellatedPass> tessellated;
    // … or compute shaders alone.
    std::optional<OpaqueRasterPass> opaqueRaster;
    std::optional<RasterPass> raster;
    std::optional<ResolvePass> resolve;
    MemoryPlan plan;
    MovingBlades blades;
    std::optional<Streaming> streaming; ///< where not all blades are in memory
    FieldShape shape;
    std::vector<FrameSlot> slots;
    double lastTime = 0.0; ///< [s] of the frame before
    std::uint32_t frameNumber = 0;
    bool hasPyramid = false;  ///< of the picture's size, and of the culling camera
    std::uint32_t rounds = 1; ///< in which the frame's blades are listed and drawn

    MemoryPlan planWithin(const field::FieldView& field);
    std::size_t bytesBesideBlades() const;
    void fit(glm::uvec2 size);
    void recordStreaming(VkCommandBuffer commands, std::uint32_t slot, double time) const;
    void stream(shared::Frame& frame, const FrameSettings& wanted, glm::uvec2 size,
                std::uint32_t slot);
    shared::Frame writeFrame(shared::Frame frame, const FrameSettings& wanted, double time,
                             std::uint32_t slot);
    FramePlace fillCullView(const shared::Frame& frame, const FrameSettings& wanted,
                            glm::uvec2 size, std::uint32_t slot);
    bool groupsDrawLarge() const;
    bool findsHidden(const FrameSettings& wanted) const; ///< of blades what others hide
    void drawOpaque(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void rasterOpaque(VkCommandBuffer commands, std::uint32_t slot, gpu::Timestamps* timestamps);
    void seeWhatIsHidden(VkCommandBuffer commands, std::uint32_t slot, gpu::Timestamps* timestamps);
    void seeWhatIsHidden(VkCommandBuffer commands, const RasterPass::Input& input,
                         gpu::Timestamps* timestamps);
    void drawBlades(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void rasterBlades(VkCommandBuffer commands, const RasterPass::Input& input,
                      gpu::Timestamps* timestamps);
    void makePicture(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                     const RasterPass::Input& input, gpu::Timestamps* timestamps);
    gpu::ColorAttachment colorAttachment(const Target& target) const;
};

} // namespace sward::render
