#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "field/measure/leaf_area.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/buffer_upload.h"
#include "render/field/free_ranges.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/frame.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::render {

class EditedCover;

/// The leaf area of a field (field/measure/leaf_area.h) in device memory. Only edits change it.
class GrassCover {
public:
    /// Begins the upload; it is complete when `upload` is.
    GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
               const field::FieldView& field, bool isEditable = false);
    /// The same with the leaf area of the field, as field::leafAreaOf() returns it. In deltas, a
    /// blade stands for `bladesPerStored`.
    GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
               const field::FieldView& field, field::LeafAreaGrid grid, bool isEditable,
               double bladesPerStored = 1.0);
    GrassCover(GrassCover&&) noexcept;
    ~GrassCover();

    /// Follows an edit. Returns the corners that change; the caller uploads them.
    PlaceRange apply(const field::Delta& delta);
    std::span<const std::uint32_t> values() const; ///< of all corners, if editable
    const gpu::Buffer& buffer() const { return values_; }

    /// Call after the frame's draw distance is set. `thatch`: FrameSettings::thatch.
    void describe(shared::Frame& frame, float thatch) const;

    VkDeviceSize bytes() const { return values_.bytes(); }

private:
    shared::Cover shape_ = {}; ///< with the colours of the undergrowth
    gpu::Buffer values_;
    std::unique_ptr<EditedCover> edited_;
};

} // namespace sward::render
