#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/buffer_upload.h"
#include "render/field/free_ranges.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/frame.h"

#include <memory>
#include <span>
#include <vector>

namespace sward::render {

/// Maximum corners of the grid along its longest axis.
constexpr std::uint32_t maxCoverCorners = 128;

/// Maximum blades read for the grid; of larger fields the first ones of each patch.
constexpr std::size_t maxCoverBlades = std::size_t(1) << 20;

/// Leaf area index of a field at the corners of a grid; see shared::Cover. The table is unset.
struct LeafAreaGrid {
    shared::Cover shape = {};
    std::vector<float> values;

    /// A view for shared functions on the CPU; valid as long as the grid.
    shared::Cover view() const;
};

/// m² of blade (one side, upright) per m² of ground. Blades and ground are distributed to the eight
/// corners around them, then divided. The integral over the ground is the blades' area; without a
/// blade within a cell the value is 0. A cell's edge is at least half the mean blade height, the
/// range at which grass darkens.
LeafAreaGrid leafAreaOf(const field::FieldView& field);

/// Its grid, also for a field without blades.
shared::Cover coverShapeOf(const field::FieldView& field);

/// m² of ground at the corners of the grid, never 0.
std::vector<float> groundAreasOf(const field::FieldView& field, const shared::Cover& shape);

/// Colours and structure of the ground under a field's grass: members undergrowth, sward, thinned
/// and structure.
void describeUndergrowth(const field::FieldView& field, shared::Cover& cover);

/// Members undergrowth and sward, from the mean colours of roots and tips.
void colorUndergrowth(const glm::vec3& root, const glm::vec3& tip, shared::Cover& cover);

class EditedCover;

/// The same in device memory. Only edits change it.
class GrassCover {
public:
    /// Begins the upload; it is complete when `upload` is.
    GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
               const field::FieldView& field, bool isEditable = false);
    GrassCover(GrassCover&&) noexcept;
    ~GrassCover();

    /// Follows an edit. Returns the corners that change; the caller uploads them.
    PlaceRange apply(const field::Delta& delta);
    std::span<const float> values() const; ///< of all corners, if editable
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
