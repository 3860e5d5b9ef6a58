#include "render/field/resident_field.h"

#include "render/field/resident_parts.h"

namespace sward::render {

ResidentField::Parts::Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field)
    : context(deviceContext)
    , upload(context)
    , blades(context, upload, field)
    , cover(context, upload, field)
    , shape{field.origin, field.bounds(), blades.bladeSize()}
    , defaults(*field.defaults)
{
}

ResidentField::ResidentField(const gpu::DeviceContext& context, const field::FieldView& field)
    : parts_(std::make_unique<Parts>(context, field))
{
}

ResidentField::~ResidentField() = default;

void ResidentField::recordUpload(VkCommandBuffer commands, VkDeviceSize maxBytes) noexcept
{
    parts_->upload.record({parts_->context, commands}, maxBytes);
}

bool ResidentField::isUploaded() const
{
    return parts_->upload.isRecorded();
}

void ResidentField::releaseStaging()
{
    parts_->upload.release();
}

glm::dvec3 ResidentField::origin() const
{
    return parts_->shape.origin;
}

Aabb ResidentField::content() const
{
    return parts_->shape.content;
}

const field::Defaults& ResidentField::defaults() const
{
    return parts_->defaults;
}

VkDeviceSize ResidentField::deviceBytes() const
{
    return parts_->blades.bytes() + parts_->cover.bytes();
}

VkDeviceSize ResidentField::stagingBytes() const
{
    return parts_->upload.bytes();
}

} // namespace sward::render
