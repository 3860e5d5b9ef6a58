#pragma once

#include "field/field.h"
#include "field/measure/distributions.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/buffer_upload.h"
#include "render/field/field_tables.h"
#include "render/field/patch_sizes.h"
#include "render/field/patch_tree.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace sward::render {

/// The baked data of a field's blades in device memory. Only edits change it.
class BakedBlades {
public:
    /// Begins the upload; it is complete when `upload` is. `walkStart`: see PatchTree. `pages`: if
    /// not 0, allocates that many pages of blades (pages.h), all empty.
    BakedBlades(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                const field::FieldView& field, std::uint32_t walkStart = shared::walkStart,
                std::uint32_t pages = 0);

    /// The same of a field whose blades change. `placed`: the blades at their places in `tables`.
    BakedBlades(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                const field::FieldView& field, const FieldTables& tables,
                std::span<const shared::PackedBlade> placed);

    /// Follows a change. The caller uploads its bytes.
    void update(const gpu::DeviceContext& context, const FieldTables& tables,
                OutgrownBuffers& outgrown);

    /// Writes addresses and counts into a frame.
    void describe(shared::Frame& frame) const;

    std::uint32_t bladeCount() const { return bladeCount_; } ///< of the field
    std::uint32_t placeCount() const { return placeCount_; } ///< of blades in memory
    /// Of blades for shaders: those of the file, or with edits places in memory.
    std::uint32_t indexCount() const { return isEditable_ ? placeCount_ : bladeCount_; }
    bool isPaged() const { return pages_.address() != 0; }    ///< false: all blades are resident
    bool hasOrgans() const { return organs_.address() != 0; } ///< there are compound plants
    std::uint32_t patchCount() const { return patchCount_; }  ///< with those that edits left free
    std::uint32_t nonEmptyPatchCount() const { return nonEmptyPatchCount_; } ///< non-empty patches
    std::uint32_t entryCount() const { return entryCount_; } ///< of nonEmptyPatches()
    bool isEditable() const { return isEditable_; }
    const gpu::Buffer& blades() const { return blades_; }          ///< shared::PackedBlade
    VkDeviceAddress patches() const { return patches_.address(); } ///< shared::Patch
    VkDeviceAddress pages() const { return pages_.address(); }     ///< Frame::pages
    VkDeviceAddress nonEmptyPatches() const
    {
        return nonEmptyPatches_.address();
    } ///< in the order of their blades; with edits, some empty ones among them
    const gpu::Buffer& patchTable() const { return patches_; }
    const gpu::Buffer& entryTable() const { return nonEmptyPatches_; }
    const gpu::Buffer& firstEntryTable() const { return firstNonEmptyPatches_; }

    /// Index into nonEmptyPatches of every shared::nonEmptyPatchStride-th blade's patch.
    VkDeviceAddress firstNonEmptyPatches() const { return firstNonEmptyPatches_.address(); }
    field::BladeSize bladeSize() const { return bladeSize_; } ///< mean over all blades
    const PatchTree& tree() const { return *tree_; }
    const PatchSizes& patchSizes() const { return patchSizes_; }
    VkDeviceSize bytes() const { return bytes_; }

private:
    void describeField(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                       const field::FieldView& field);
    void count(const FieldTables& tables);
    gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes,
                         bool isFilledByCopyQueue = false);

    std::uint32_t bladeCount_ = 0;
    std::uint32_t placeCount_ = 0;
    std::uint32_t patchCount_ = 0;
    std::uint32_t nonEmptyPatchCount_ = 0;
    std::uint32_t entryCount_ = 0;
    bool isEditable_ = false;
    field::BladeSize bladeSize_;
    PatchSizes patchSizes_;
    VkDeviceSize bytes_ = 0;

    gpu::Buffer blades_;
    gpu::Buffer patches_;
    gpu::Buffer pages_; ///< empty if all blades are resident
    gpu::Buffer species_;
    gpu::Buffer organs_; ///< of compound plants, if there are any
    float areaFactor_ = 1.0f;
    gpu::Buffer nonEmptyPatches_;
    gpu::Buffer firstNonEmptyPatches_;
    std::optional<PatchTree> tree_;
};

} // namespace sward::render
