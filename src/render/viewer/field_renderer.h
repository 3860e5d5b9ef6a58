#pragma once

#include "field/delta.h"
#include "field/owned_field.h"
#include "render/field/blade_record.h"
#include "render/frame/camera.h"
#include "render/frame/frame_settings.h"
#include "render/frame/frame_stats.h"
#include "render/viewer/field_renderer_settings.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sward::gpu {
class Device;
struct DeviceContext;
class Timestamps;
} // namespace sward::gpu

namespace sward::render {

using LayerMask = std::uint32_t; ///< layers/frame_layers.h
struct LayerWords;

/// Draws one field into the caller's pictures. Starts no threads but for a field that is sown, owns
/// no window, submits nothing while recording (but see copied()). The constructor uploads the field
/// and waits for it.
class FieldRenderer {
public:
    using Settings = FieldRendererSettings; ///< constant over all frames

    /// The context must outlive it. A field that is streamed or sown is kept if it is owned; a mere
    /// view of it must stay valid. Others may be destroyed, but dumpBlades() needs them again.
    /// Throws Error{runtime} if the device's memory or the budget is too small, naming both sizes;
    /// Error{unsupported} if the device cannot draw the requested geometry.
    FieldRenderer(const gpu::DeviceContext&, const field::OwnedField&, const Settings&);
    FieldRenderer(const gpu::DeviceContext&, const field::FieldView&, const Settings&); ///< a view
    FieldRenderer(const gpu::Device&, const field::FieldView&, const Settings&); ///< of Sward
    FieldRenderer(FieldRenderer&&) noexcept; ///< only between frames
    ~FieldRenderer();

    /// Replaces 32 m cells of the field, between frames; the next frame's commands carry it out.
    /// Blades whose key the cell had before keep their state, others appear settled in the wind of
    /// that frame. Neither waits for the device nor needs the delta afterwards. Throws, and changes
    /// nothing: Error{usage} unless Settings::isEditable; Error{unsupported} if the field is
    /// streamed or would have too many blades; Error{input} if the delta is damaged or of a field
    /// with another origin.
    void apply(const field::Delta& delta);

    /// A picture to draw into. It is in layout COLOR_ATTACHMENT_OPTIMAL before and after the
    /// commands run. For raster geometry its usage includes TRANSFER_DST, unless it is `stored`.
    struct Target {
        VkImage image = VK_NULL_HANDLE;    ///< one sample, one layer
        VkImageView view = VK_NULL_HANDLE; ///< of the image
        glm::uvec2 size{0};                ///< [pixels]

        /// A storage view of the image as R8G8B8A8_UNORM; the shader stores bytes in the image's
        /// own format. Null: the picture is copied to the image.
        VkImageView stored = VK_NULL_HANDLE;

        /// If `whole` is not 0: the picture is the part of one of `whole` pixels that begins at
        /// pixel `first`. Not for streamed fields, which hold what one view shows.
        glm::uvec2 whole{0};
        glm::ivec2 first{0};                   ///< [pixels]
        LayerMask layers = 0;                  ///< to be written besides: see layerWords()
        VkBuffer layerBuffer = VK_NULL_HANDLE; ///< for their words; null: one of the renderer's
        /// Of the frame before, for flow; null: the camera of the last record().
        const Camera* cameraBefore = nullptr;
    };

    /// Records one frame: moves the blades of visible patches to `time` [s] (as GrassFrame::time),
    /// culls, draws ground, sky and blades. The former commands of `slot` < framesInFlight must
    /// have completed. `jitter` is in pixels. `timestamps` may be null; otherwise the caller has
    /// begun its frame, and the scopes update (includes culling), ground, sky, pyramid, blades and
    /// resolve are measured. A new target size allocates and waits for the device. The first target
    /// without storage view allocates a picture to copy from. New mixtures of winds, colliders and
    /// --debug wind create pipelines at their first frame.
    void record(VkCommandBuffer commands, const Target& target, const Camera& camera,
                const FrameSettings& settings, double time, std::uint32_t slot = 0,
                gpu::Timestamps* timestamps = nullptr, glm::vec2 jitter = glm::vec2(0.0f));

    /// The layers of the frame last recorded in `slot` (Target::layers), after its commands have
    /// completed. layersOf() makes arrays of them. Layer::flowForward is that of the frame recorded
    /// before, if that had it, too: its places are followed to this frame. With a
    /// Target::layerBuffer, which gets layerBytes() by a transfer, no words are copied and read.
    LayerWords layerWords(const field::FieldView& field, std::uint32_t slot = 0) const;

    /// Lets the next frame begin anew: its blades are settled in its wind, whatever was drawn
    /// before. Pictures of a field in memory then depend on what is recorded from there on alone.
    void forgetMotion();

    /// Moves all blades to `time` and draws nothing: for frames before the first one shown.
    void recordUpdateOnly(VkCommandBuffer commands, const FrameSettings& settings, double time,
                          std::uint32_t slot = 0);

    /// Streams more blades of the view that record() would draw; draws nothing. Returns true when
    /// no further blade fits or is missing. Frames in between must have completed.
    bool recordStreaming(VkCommandBuffer commands, glm::uvec2 size, const Camera& camera,
                         const FrameSettings& settings, double time, std::uint32_t slot = 0);

    /// The semaphore wait for submitting a streamed field's frame, if the context has a copy queue,
    /// to which record() submits. It is already signalled; the wait makes the copies visible.
    std::optional<VkSemaphoreSubmitInfo> copied() const;

    /// Counts of the frame last recorded in `slot`, after its commands have completed.
    FrameStats stats(std::uint32_t slot = 0) const;

    using BladeRecord = render::BladeRecord; ///< result of dumpBlades()

    /// Reads back every blade's state in file order, and then of those that are sown, unit by unit;
    /// waits for the device. After an edit `field` is the edited field, and a frame has been drawn.
    /// Throws Error{unsupported} if the field is streamed.
    std::vector<BladeRecord> dumpBlades(const field::FieldView& field) const;

    /// The same for one patch, without `lodWidth`; empty if its blades are not resident.
    std::vector<BladeRecord> dumpPatch(const field::FieldView& field, std::uint32_t patch) const;

    /// The patches of blades that are sown and in memory; empty if there are none.
    std::vector<SownPatch> sownPatches() const;

    /// dumpPatch() of one of these, with its blades; nothing if it is no longer in memory. Each
    /// blade is followed by the ribbons that stand on it.
    SownDump dumpSown(const field::FieldView& field, const SownPatch& patch) const;

    /// Key of blade `index` of such a patch; grows its unit again, which takes some 10 ms.
    field::BladeKey keyOf(const SownPatch& patch, std::uint32_t index) const;

    /// The geometry in use, never automatic, and the reason.
    Geometry geometry() const;
    const char* geometryReason() const; ///< in words

    bool isStreamed() const;         ///< not all blades fit in memory
    bool isSown() const;             ///< blades near the eye are sown from the field's seeds
    bool isSettled() const;          ///< with a still eye no blades come or go any more
    std::size_t deviceBytes() const; ///< device memory in use
    Aabb content() const;            ///< box of everything visible, relative to the origin

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
