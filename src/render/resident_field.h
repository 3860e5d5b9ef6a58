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

/// A field's blades on a device, however often and wherever they are drawn. It comes there by
/// commands of the host, at once or in pieces; instances of it are left out until then.
class ResidentField {
public:
    /// Allocates, and copies the field into mapped memory; `field` may die. Submits nothing.
    /// `context` outlives it. Throws Error{runtime} where memory does not suffice.
    ResidentField(const gpu::DeviceContext& context, const field::FieldView& field);
    ResidentField(const ResidentField&) = delete;
    ResidentField& operator=(const ResidentField&) = delete;
    ~ResidentField(); ///< after the commands of the last frame that draws it

    /// Records the copy of at most `maxBytes` more, outside of a rendering; nothing when all is
    /// recorded. Instances are drawn from the frame on that begins after the last piece: its
    /// commands are submitted later than these.
    void recordUpload(VkCommandBuffer commands, VkDeviceSize maxBytes = VK_WHOLE_SIZE) noexcept;
    bool isUploaded() const; ///< all of it is recorded

    /// Frees the mapped memory, after the commands of the whole upload have completed.
    void releaseStaging();

    glm::dvec3 origin() const;               ///< that places of its content are relative to [m]
    Aabb content() const;                    ///< what can be seen [m]
    const field::Defaults& defaults() const; ///< saved in it, as the field counts
    VkDeviceSize deviceBytes() const;
    VkDeviceSize stagingBytes() const;

    struct Parts;
    const Parts& parts() const { return *parts_; } ///< for Sward's own passes

private:
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
