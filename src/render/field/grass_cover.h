#pragma once

#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/buffer_upload.h"
#include "gpu/context.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/frame.h"

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

/// Colours and structure of the ground under a field's grass: members undergrowth, sward, thinned
/// and structure.
void describeUndergrowth(const field::FieldView& field, shared::Cover& cover);

/// The same in device memory, computed once.
class GrassCover {
public:
    /// Begins the upload; it is complete when `upload` is.
    GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
               const field::FieldView& field);

    /// Call after the frame's draw distance is set. `thatch`: FrameSettings::thatch.
    void describe(shared::Frame& frame, float thatch) const;

    VkDeviceSize bytes() const { return values_.bytes(); }

private:
    shared::Cover shape_ = {}; ///< with the colours of the undergrowth
    gpu::Buffer values_;
};

} // namespace sward::render
