#pragma once

#include "core/bounds.h"
#include "field/field.h"

#include <glm/vec3.hpp>
#include <vulkan/vulkan.h>

#include <memory>

namespace sward::gpu {
struct DeviceContext;
} // namespace sward::gpu

namespace sward::render {

/// A field's blades on a device, shared by all instances. The host's command buffers upload it, at
/// once or in pieces; its instances are skipped until then.
class ResidentField {
public:
    /// Allocates, and copies the field into mapped memory; `field` may be destroyed. Submits
    /// nothing. `context` must outlive it. Throws Error{runtime} if there is not enough memory.
    ResidentField(const gpu::DeviceContext& context, const field::FieldView& field);
    ResidentField(const ResidentField&) = delete;
    ResidentField& operator=(const ResidentField&) = delete;
    ~ResidentField(); ///< after the commands of the last frame that draws it

    /// Records the copy of at most `maxBytes` more, outside of a rendering; nothing if all is
    /// recorded. Its instances are drawn from the first frame begun after the last piece. That
    /// frame must be submitted after these commands.
    void recordUpload(VkCommandBuffer commands, VkDeviceSize maxBytes = VK_WHOLE_SIZE) noexcept;
    bool isUploaded() const; ///< the whole upload is recorded

    /// Frees the mapped memory, after the commands of the whole upload have completed.
    void releaseStaging();

    glm::dvec3 origin() const;               ///< [m] of places in its content
    Aabb content() const;                    ///< box of everything visible [m]
    const field::Defaults& defaults() const; ///< saved in the field, in its space
    VkDeviceSize deviceBytes() const;
    VkDeviceSize stagingBytes() const;

    struct Parts;
    const Parts& parts() const { return *parts_; } ///< for Sward's own passes

private:
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
