#pragma once

#include "core/bounds.h"
#include "field/owned_field.h"

#include <glm/vec3.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sward::field {
struct Defaults;
struct Delta;
struct FieldView;
} // namespace sward::field

namespace sward::gpu {
struct DeviceContext;
} // namespace sward::gpu

namespace sward::render {

/// Limit of the device memory of a field and of its instances. What does not fit is streamed
/// (decision 0036): blades that the frames' views see come by pages, others go.
struct FieldBudget {
    std::uint64_t bytes = 0;          ///< mapped memory of the copies included; 0: unlimited
    std::uint32_t instances = 1;      ///< included in `bytes`: that many instances, …
    std::uint32_t views = 1;          ///< … their lists for that many views each …
    bool keepsMotion = false;         ///< … and Grass::Settings::keepsMotion
    std::uint32_t framesInFlight = 2; ///< at least Grass::Settings::framesInFlight
    bool waitsForDisk = false;        ///< false: blades not in CPU memory come in later frames
    bool isEditable = false;          ///< for Grass::edit(): not streamed; edits may need more; may
                                      ///< be sown

    /// For the blades that a field with seeds sows near the views (decision 0045); 0: none. At most
    /// half of `bytes`, if these are limited.
    std::uint64_t sownBytes = std::uint64_t(512) << 20;
    std::uint32_t sowThreads = 1;       ///< of the field: unpack seeds, grow blades; 0: frames do
    std::optional<bool> sowsOnDevice{}; ///< shaders grow the blades; none: unless it is a CPU
};

/// A field's blades on a device, shared by all instances. The host's command buffers upload it, at
/// once or in pieces; its instances are skipped until then.
class ResidentField {
public:
    /// Allocates, and copies the field into mapped memory; of a field that is streamed or
    /// sown, keeps `field`. Submits nothing. `context` must outlive it. Throws Error{runtime} if
    /// memory or budget is too small; Error{usage} if a number of the budget is 0, or if the field
    /// has no keys and is to be editable.
    ResidentField(const gpu::DeviceContext& context, const field::OwnedField& field,
                  const FieldBudget& budget = {});

    /// The same without a budget: copies all, is neither streamed nor sown nor editable. What
    /// `field` views may be destroyed afterwards.
    ResidentField(const gpu::DeviceContext& context, const field::FieldView& field);
    ResidentField(const ResidentField&) = delete;
    ResidentField& operator=(const ResidentField&) = delete;
    ~ResidentField(); ///< after the commands of the last frame that draws it

    /// Records the copy of at most `maxBytes` more, outside of a rendering; nothing if all is
    /// recorded. Its instances are drawn from the first frame begun after the last piece. That
    /// frame must be submitted after these commands. Throws Error{usage} if `commands` is null.
    void recordUpload(VkCommandBuffer commands, VkDeviceSize maxBytes = VK_WHOLE_SIZE);
    bool isUploaded() const; ///< the whole upload is recorded

    /// Frees the mapped memory, after the commands of the whole upload have completed. Throws
    /// Error{usage} if not all of it has been recorded.
    void releaseStaging();

    /// Whether not all blades fit into the budget. One Grass alone may then draw it.
    bool isStreamed() const;
    bool isSown() const; ///< it sows blades from its seeds: again for one Grass alone

    /// What LayerInstance::ids is, of the frame that Grass has begun last, for its layers; null
    /// unless the field is sown or has been edited. `field` is what this was made of, or has been
    /// edited to. Takes some 10 ms for each unit that is sown.
    std::shared_ptr<const std::vector<std::uint64_t>> layerIds(const field::FieldView& field) const;

    glm::dvec3 origin() const;               ///< [m] of places in its content
    Aabb content() const;                    ///< box of everything visible [m]
    const field::Defaults& defaults() const; ///< saved in the field, in its space
    VkDeviceSize deviceBytes() const;        ///< with the mapped memory of streaming and edits
    VkDeviceSize stagingBytes() const;       ///< of the upload

    struct Parts; ///< its members; private to the library

private:
    friend struct Access;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
