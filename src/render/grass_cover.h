#pragma once

#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/buffer_upload.h"
#include "gpu/context.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/frame.h"

#include <vector>

namespace sward::render {

/// Corners of the grid along its longest axis, at most.
constexpr std::uint32_t maxCoverCorners = 128;

/// Blades that are read for it, at most: of larger fields the first ones of each patch.
constexpr std::size_t maxCoverBlades = std::size_t(1) << 20;

/// Leaf area index of a field at the corners of a grid; see shared::Cover, whose table is left out.
struct LeafAreaGrid {
    shared::Cover shape = {};
    std::vector<float> values;

    /// For shared functions on the CPU; lives as long as the grid.
    shared::Cover view() const;
};

/// m² of blade (one side, upright) per m² of ground: blades and ground are both dealt to the eight
/// corners around them, and divided there. Integrated over the ground it gives the blades' area
/// back; where no blade is within a cell it is 0. A cell's edge is half a blade's mean height or
/// more: grass darkens what is that near.
LeafAreaGrid leafAreaOf(const field::FieldView& field);

/// The same in device memory, made once.
class GrassCover {
public:
    /// Begins the upload; it is complete when `upload` is.
    GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
               const field::FieldView& field);

    /// After the frame's draw distance is known.
    void describe(shared::Frame& frame) const;

    VkDeviceSize bytes() const { return values_.bytes(); }

private:
    shared::Cover shape_ = {};
    gpu::Buffer values_;
};

} // namespace sward::render
