#pragma once

#include "field/delta.h"
#include "field/field.h"
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

/// Maximum corners of the grid along its longest axis.
constexpr std::uint32_t maxCoverCorners = 128;

/// Maximum blades read for the grid; of larger fields the first ones of each patch.
constexpr std::size_t maxCoverBlades = std::size_t(1) << 20;

/// The grass of a field at the corners of a grid; see shared::Cover. The table is unset.
struct LeafAreaGrid {
    shared::Cover shape = {};
    float meanHeight = 0.0f; ///< [m] of the blades, which the values' heights are relative to
    std::vector<std::uint32_t> values; ///< shared::packGrass()

    /// A view for shared functions on the CPU; valid as long as the grid.
    shared::Cover view() const;
};

/// m² of blade (one side, upright) per m² of ground. Blades and ground are distributed to the eight
/// corners around them, then divided. The integral over the ground is the blades' area; without a
/// blade within a cell the value is 0. A cell's edge is at least half the mean blade height, the
/// range at which grass darkens.
LeafAreaGrid leafAreaOf(const field::FieldView& field);

/// shared::packGrass() of a corner: [m²] of leaves there, that times the height [m] of their
/// blades, and [m²] of ground.
std::uint32_t grassOf(float leaves, float heights, float ground, float meanHeight);

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
