#pragma once

#include "field/field.h"
#include "render/blade_record.h"
#include "render/camera.h"
#include "render/field_renderer_settings.h"
#include "render/frame_settings.h"

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

/// Draws one field into the caller's pictures. Starts no threads, owns no window, submits nothing
/// while recording (but see copied()); construction uploads the field and waits for it.
class FieldRenderer {
public:
    using Settings = FieldRendererSettings; ///< what stays the same from frame to frame

    /// Outlived by the context. `field` may die, except that dumpBlades() needs it again. Throws
    /// Error{runtime} when the device's memory, or the budget, is too small, naming both sizes;
    /// Error{unsupported} where a geometry is asked for that the device cannot draw.
    FieldRenderer(const gpu::DeviceContext&, const field::FieldView&, const Settings&);
    FieldRenderer(const gpu::Device&, const field::FieldView&, const Settings&); ///< of our own
    FieldRenderer(FieldRenderer&&) noexcept; ///< only between frames
    ~FieldRenderer();

    /// A picture to draw into: in layout COLOR_ATTACHMENT_OPTIMAL when the commands run, and left
    /// in it. Where the geometry is raster its usage includes TRANSFER_DST, unless it is `stored`.
    struct Target {
        VkImage image = VK_NULL_HANDLE;    ///< one sample, one layer
        VkImageView view = VK_NULL_HANDLE; ///< of the image
        glm::uvec2 size{0};                ///< [pixels]

        /// A view of the image for storage, as R8G8B8A8_UNORM, into which the bytes of the image's
        /// own format are stored. Null if there is none: the picture is then copied to the image.
        VkImageView stored = VK_NULL_HANDLE;
    };

    /// Records one frame: moves the blades of visible patches to `time` [s] (monotone; any step is
    /// safe), culls, draws ground, sky and blades. `slot` < framesInFlight, whose former commands
    /// have completed. `jitter` [pixels]. `timestamps` may be null; else the caller has begun their
    /// frame, and the scopes update (which culls as well), ground, sky, pyramid, blades and resolve
    /// are measured. Nothing is allocated unless the target's size has changed; then the device is
    /// waited for. The first target that cannot be stored into has a picture made to copy from. A
    /// mixture of winds, colliders and --debug wind have their pipelines made at their first frame.
    void record(VkCommandBuffer commands, const Target& target, const Camera& camera,
                const FrameSettings& settings, double time, std::uint32_t slot = 0,
                gpu::Timestamps* timestamps = nullptr, glm::vec2 jitter = glm::vec2(0.0f));

    /// Moves all blades to `time` and draws nothing: frames before the first that is wanted.
    void recordUpdateOnly(VkCommandBuffer commands, const FrameSettings& settings, double time,
                          std::uint32_t slot = 0);

    /// Brings more of what record() would draw of a streamed field, and draws nothing. Returns true
    /// when nothing is left to be brought that fits; the frames between them have completed then.
    bool recordStreaming(VkCommandBuffer commands, glm::uvec2 size, const Camera& camera,
                         const FrameSettings& settings, double time, std::uint32_t slot = 0);

    /// What the submission of a streamed field's frame waits for where its context has a queue for
    /// copies, to which record() submits: it has happened already, and is made seen.
    std::optional<VkSemaphoreSubmitInfo> copied() const;

    /// Counts of the frame last recorded in `slot`, after its commands have completed.
    FrameStats stats(std::uint32_t slot = 0) const;

    using BladeRecord = render::BladeRecord; ///< what dumpBlades() tells of each

    /// Reads every blade's state back, in the order of the file; waits for the device. Throws
    /// Error{unsupported} of a field that is streamed.
    std::vector<BladeRecord> dumpBlades(const field::FieldView& field) const;

    /// The same for one patch, without `lodWidth`; nothing if its blades are not in memory.
    std::vector<BladeRecord> dumpPatch(const field::FieldView& field, std::uint32_t patch) const;

    /// What draws the blades, never automatic, and why it does.
    Geometry geometry() const;
    const char* geometryReason() const; ///< in words

    bool isStreamed() const;         ///< not all blades fit
    std::size_t deviceBytes() const; ///< device memory held
    Aabb content() const;            ///< what can be seen, relative to the field's origin

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
