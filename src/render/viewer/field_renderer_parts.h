#pragma once

#include "gpu/context/context.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/rendering.h"
#include "gpu/recording/timestamps.h"
#include "render/layers/layers_pass.h"
#include "render/preview/floor_plane.h"
#include "render/preview/opaque_pass.h"
#include "render/preview/opaque_raster_pass.h"
#include "render/preview/sun_shadow.h"
#include "render/recorder.h"
#include "render/resident/device_field.h"
#include "render/resolve/resolve_pass.h"
#include "render/resolve/target_settings.h"
#include "render/viewer/attachments.h"
#include "render/viewer/field_renderer.h"
#include "render/viewer/memory_plan.h"
#include "render/viewer/tessellated_pass.h"

#include <memory>
#include <optional>
#include <vector>

namespace sward::render {

/// Members of a field's renderer, and the steps of its frames. It hands the recorder of hosts'
/// frames its only view, on a ground of its own.
struct FieldRenderer::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& view,
          const Settings& wanted);

    /// Throw Error{usage} that names what is wrong.
    static const gpu::DeviceContext& checked(const gpu::DeviceContext& given,
                                             const field::FieldView& field, const Settings& wanted);
    gpu::Recording recording(VkCommandBuffer commands, const FrameSettings& wanted, double time,
                             std::uint32_t slot) const;

    Settings settings;
    Geometry geometry; ///< never automatic
    Recorder recorder;
    const gpu::DeviceContext& context; ///< the recorder's
    TargetSettings targetSettings;
    GroundBuffers ground;
    SunShadowPass sunShadow;
    glm::vec3 floorUp;             ///< unit, against the field's own gravity; 0: a planet
    shared::FloorPlane floorPlane; ///< across it
    glm::uvec2 pictureSize{0};     ///< [pixels] of the current pictures

    // With tessellation: the graphics pipeline …
    std::optional<Attachments> attachments;
    std::optional<OpaquePass> opaque;
    std::optional<TessellatedPass> tessellated;
    // … with raster: compute shaders only.
    std::optional<OpaqueRasterPass> opaqueRaster;
    std::optional<ResolvePass> resolve;

    OpaqueLayer layer;                  ///< of the frame being recorded
    BladeRecords records;               ///< per blade
    std::unique_ptr<DeviceField> field; ///< what the instance shows
    std::optional<field::OwnedField>
        source;                       ///< what streaming and sowing read, unless the caller has it
    PlacedField* blades = nullptr;    ///< the only instance of the recorder
    double lastTime = 0.0;            ///< [s] of the frame before
    float elapsed = 0.0f;             ///< [s] since then, of the frame being recorded
    std::optional<LayersPass> layers; ///< made when the first are wanted
    std::optional<glm::mat4> seenBefore; ///< projection of the last picture
    std::uint32_t frameNumber = 0;
    shared::DepthPyramid frozen = {}; ///< of the last picture whose camera culled; may be none

    /// A frame as it is recorded.
    struct View {
        glm::uvec2 target{0}; ///< [pixels]
        glm::uvec2 whole{0};  ///< [pixels] of the picture that the target is a part of
        ViewMatrices matrices{};
        Geometry geometry = Geometry::automatic;
        std::optional<glm::mat4> before{}; ///< projection of the frame before
        LayerMask layers = 0;
        bool onlyMoves = false; ///< see ViewExtras
    };

    std::unique_ptr<DeviceField> uploadedField(const field::FieldView& view);
    MemoryPlan planWithin(const field::FieldView& view, VkDeviceSize coverBytes);
    std::unique_ptr<EditedField> editedOf(const field::FieldView& view) const;
    bool sows(const field::FieldView& view) const;
    std::unique_ptr<DeviceField> sownField(const field::FieldView& view);
    std::size_t bytesBesideBlades() const;
    void measurePictures();
    void fit(glm::uvec2 size);
    HostView hostView(const View& view, const FrameSettings& wanted) const;
    void begin(const View& view, const FrameSettings& wanted, double time, std::uint32_t slot);
    InstanceFrame instanceOf(const View& view, const FrameSettings& wanted, double time);
    void prepare(const FrameSettings& wanted);
    void drawOpaque(const gpu::Recording& commands, const Target& target,
                    gpu::Timestamps* timestamps);
    void drawBlades(const gpu::Recording& commands, const Target& target,
                    gpu::Timestamps* timestamps);
    void makePicture(const gpu::Recording& commands, const Target& target,
                     gpu::Timestamps* timestamps);
    void checkLayers(const Target& target) const;
    std::optional<glm::mat4> projectionBefore(const Target& target, glm::uvec2 whole) const;
    void prepareLayers(const FrameSettings& wanted);
    void recordLayers(const gpu::Recording& commands, const Target& target,
                      const shared::RasterPush& push, gpu::Timestamps* timestamps);
    gpu::ColorAttachment colorAttachment(const Target& target) const;
    FramePlace frame() const
    {
        return blades->place(recorder.slot, InstanceConstants::Kind::raster, 0);
    } ///< of the picture
};

} // namespace sward::render
