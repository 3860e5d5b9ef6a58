#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/rendering.h"
#include "gpu/recording/timestamps.h"
#include "render/cull/depth_pyramid.h"
#include "render/cull/moving_blades.h"
#include "render/field/grass_cover.h"
#include "render/frame/frame.h"
#include "render/preview/opaque_pass.h"
#include "render/preview/opaque_raster_pass.h"
#include "render/preview/sun_shadow.h"
#include "render/resolve/resolve_pass.h"
#include "render/resolve/target_settings.h"
#include "render/streaming/streaming.h"
#include "render/viewer/attachments.h"
#include "render/viewer/field_renderer.h"
#include "render/viewer/frame_slot.h"
#include "render/viewer/memory_plan.h"
#include "render/viewer/tessellated_pass.h"
#include "render/viewer/viewer_raster.h"

#include <memory>
#include <optional>
#include <vector>

namespace sward::render {

/// Members of a field's renderer, and the steps of its frames.
struct FieldRenderer::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field,
          const Settings& wanted);

    /// Throw Error{usage} that names what is wrong.
    static const gpu::DeviceContext& checked(const gpu::DeviceContext& given,
                                             const field::FieldView& field, const Settings& wanted);
    void requireFrame(VkCommandBuffer commands, const FrameSettings& wanted, double time,
                      std::uint32_t slot) const;

    const gpu::DeviceContext& context;
    Settings settings;
    Geometry geometry; ///< never automatic
    gpu::ShaderLibrary shaders;
    TargetSettings targetSettings;
    GroundBuffers ground;
    GrassCover cover;
    SunShadowPass sunShadow;
    DepthPyramid pyramid;
    glm::uvec2 pictureSize{0}; ///< [pixels] of the current pictures

    // With tessellation: the graphics pipeline …
    std::optional<Attachments> attachments;
    std::optional<OpaquePass> opaque;
    std::optional<TessellatedPass> tessellated;
    // … with raster: compute shaders only.
    std::optional<OpaqueRasterPass> opaqueRaster;
    std::optional<ViewerRaster> raster;
    std::optional<ResolvePass> resolve;
    MemoryPlan plan;
    std::unique_ptr<EditedField> edited; ///< of an editable field, until `blades` has it
    MovingBlades blades;
    std::optional<field::OwnedField> source; ///< what `streaming` reads, unless the caller has it
    std::optional<Streaming> streaming;      ///< if not all blades are resident
    FieldShape shape;
    std::vector<FrameSlot> slots;
    double lastTime = 0.0; ///< [s] of the frame before
    std::uint32_t frameNumber = 0;
    bool hasPyramid = false;  ///< it fits the picture's size and the culling camera
    std::uint32_t rounds = 1; ///< rounds that list and draw the frame's blades

    MemoryPlan planWithin(const field::FieldView& field);
    std::unique_ptr<EditedField> editedOf(const field::FieldView& field) const;
    std::size_t bytesBesideBlades() const;
    void fit(glm::uvec2 size);
    void recordStreaming(const gpu::Recording& commands, std::uint32_t slot, double time) const;
    void stream(shared::Frame& frame, const FrameSettings& wanted, glm::uvec2 size,
                std::uint32_t slot);
    shared::Frame writeFrame(shared::Frame frame, const FrameSettings& wanted, double time,
                             std::uint32_t slot);
    FramePlace fillCullView(const shared::Frame& frame, const FrameSettings& wanted,
                            glm::uvec2 size, std::uint32_t slot);
    bool groupsDrawLarge() const;
    bool findsHidden(const FrameSettings& wanted) const; ///< occlusion test between blades
    void drawOpaque(const gpu::Recording& commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void rasterOpaque(const gpu::Recording& commands, std::uint32_t slot,
                      gpu::Timestamps* timestamps);
    void seeWhatIsHidden(const gpu::Recording& commands, std::uint32_t slot,
                         gpu::Timestamps* timestamps);
    void seeWhatIsHidden(const gpu::Recording& commands, const ViewerRaster::Input& input,
                         gpu::Timestamps* timestamps);
    void drawBlades(const gpu::Recording& commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void rasterBlades(const gpu::Recording& commands, const ViewerRaster::Input& input,
                      gpu::Timestamps* timestamps);
    void makePicture(const gpu::Recording& commands, const Target& target, std::uint32_t slot,
                     const ViewerRaster::Input& input, gpu::Timestamps* timestamps);
    gpu::ColorAttachment colorAttachment(const Target& target) const;
};

} // namespace sward::render
