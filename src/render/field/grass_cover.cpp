#include "render/field/grass_cover.h"

#include "render/field/edited_cover.h"

#include <limits>

namespace sward::render {

GrassCover::GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                       const field::FieldView& field, bool isEditable)
    : GrassCover(context, upload, field, field::leafAreaOf(field), isEditable)
{
}

GrassCover::GrassCover(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                       const field::FieldView& field, field::LeafAreaGrid grid, bool isEditable,
                       double bladesPerStored)
{
    if (isEditable) {
        if (grid.values.empty()) {
            grid.shape = field::coverShapeOf(field);
            grid.values.resize(std::size_t(grid.shape.countX) * grid.shape.countY *
                               grid.shape.countZ);
        }
        edited_ = std::make_unique<EditedCover>(field, grid, bladesPerStored);
    }
    shape_ = grid.shape;
    field::describeUndergrowth(field, shape_);
    values_ = gpu::Buffer(
        context, {.name = "grass cover",
                  .bytes = grid.values.size() * sizeof(std::uint32_t),
                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    upload.toBuffer(values_, std::span<const std::uint32_t>(grid.values));
}

GrassCover::GrassCover(GrassCover&&) noexcept = default;
GrassCover::~GrassCover() = default;

PlaceRange GrassCover::apply(const field::Delta& delta)
{
    return edited_->apply(delta, shape_);
}

std::span<const std::uint32_t> GrassCover::values() const
{
    return edited_->values();
}

void GrassCover::describe(shared::Frame& frame, float thatch) const
{
    frame.cover = shape_;
    frame.cover.thatch = thatch;
    frame.cover.grass.address = values_.address();
    frame.cover.farthest = (frame.view.cullMask & shared::cullDistance) != 0
                               ? frame.view.drawDistance
                               : std::numeric_limits<float>::max();
}

} // namespace sward::render
