#include "render/resident/resident_field.h"

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/pipeline/shader_library.h"
#include "render/field/edited_field.h"
#include "render/resident/resident_parts.h"
#include "render/streaming/page_budget.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <limits>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {

namespace {

const gpu::DeviceContext& contextForField(const gpu::DeviceContext& context,
                                          const field::FieldView& field, const FieldBudget& budget)
{
    gpu::requireDevice(context);
    requireUsage(field.defaults != nullptr, "the field view has no defaults");
    requireUsage(budget.framesInFlight >= 1, "FieldBudget::framesInFlight is 0");
    requireUsage(budget.instances >= 1, "FieldBudget::instances is 0");
    requireUsage(budget.views >= 1, "FieldBudget::views is 0");
    return context;
}

/// Bytes of a field with room for `places` blades, and of the instances of its budget.
std::uint64_t bytesWith(const field::FieldView& field, const FieldBudget& budget,
                        std::uint64_t places)
{
    const std::uint64_t perInstance = sizeof(shared::BladeState) +
                                      (budget.keepsMotion ? sizeof(shared::BladeState::turn) : 0) +
                                      budget.views * sizeof(shared::VisibleBlade);
    return treeBytes(field, budget.instances, budget.views) +
           places * (sizeof(shared::PackedBlade) + budget.instances * perInstance);
}

Streaming::Settings streamingWithin(const FieldBudget& budget, std::uint64_t pages)
{
    Streaming::Settings settings = streamingOf(pages, budget.framesInFlight, budget.waitsForDisk);
    settings.usesCopyQueue = false;
    return settings;
}

/// The tables of a field that is to be edited; else null. `others` as in pagesOf().
std::unique_ptr<EditedField> editedOf(const field::FieldView& field, const FieldBudget& budget,
                                      std::uint64_t others)
{
    if (!budget.isEditable)
        return nullptr;
    auto edited = std::make_unique<EditedField>(field, shared::walkStart,
                                                std::numeric_limits<std::uint32_t>::max() - 1);
    const std::uint64_t needed = others + bytesWith(field, budget, edited->bladeRoom());
    if (budget.bytes > 0 && needed > budget.bytes)
        fail(ErrorKind::runtime,
             "the field's {} blades need {} MiB to be edited, and FieldBudget::bytes is {} MiB; a "
             "field that is streamed cannot be edited",
             field.blades.size(), (needed >> 20) + 1, budget.bytes >> 20);
    return edited;
}

/// Pages of blades that fit; 0: all blades do. `others` [bytes] of the field's other members.
std::uint32_t pagesOf(const field::FieldView& field, const FieldBudget& budget,
                      std::uint64_t others)
{
    if (budget.bytes == 0)
        return 0;
    return pagesWithin(field, {.bytes = budget.bytes,
                               .whole = others + bytesWith(field, budget, field.blades.size()),
                               .with = [&](std::uint64_t pages) {
                                   return others +
                                          bytesWith(field, budget, pages * shared::pageBlades) +
                                          pagingBytes(field, streamingWithin(budget, pages));
                               }});
}

DeviceField fieldOf(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                    const field::FieldView& field, const FieldBudget& budget)
{
    GrassCover cover(context, upload, field, budget.isEditable);
    DeviceField::Settings settings{.walkStart =
                                       context.isCpu() ? shared::walkStart : shared::walkStartOfGpu,
                                   .framesInFlight = budget.framesInFlight};
    settings.edited = editedOf(field, budget, cover.bytes());
    if (!settings.edited)
        settings.pages = pagesOf(field, budget, cover.bytes());
    settings.streaming = streamingWithin(budget, settings.pages);
    return {context,          gpu::ShaderLibrary(embedded::shaders()),
            upload,           field,
            std::move(cover), std::move(settings)};
}

} // namespace

ResidentField::Parts::Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& view,
                            const FieldBudget& wanted)
    : context(contextForField(deviceContext, view, wanted))
    , upload(context)
    , budget(wanted)
    , field(fieldOf(context, upload, view, wanted))
    , defaults(*view.defaults)
{
}

ResidentField::ResidentField(const gpu::DeviceContext& context, const field::OwnedField& field,
                             const FieldBudget& budget)
    : parts_(std::make_unique<Parts>(context, field.view(), budget))
{
    if (isStreamed())
        parts_->source = field;
}

ResidentField::ResidentField(const gpu::DeviceContext& context, const field::FieldView& field)
    : parts_(std::make_unique<Parts>(context, field, FieldBudget{}))
{
}

ResidentField::~ResidentField() = default;

void ResidentField::recordUpload(VkCommandBuffer commands, VkDeviceSize maxBytes)
{
    requireUsage(commands != VK_NULL_HANDLE, "the command buffer is null");
    parts_->upload.record({parts_->context, commands}, maxBytes);
}

bool ResidentField::isUploaded() const
{
    return parts_->upload.isRecorded();
}

void ResidentField::releaseStaging()
{
    requireUsage(isUploaded(),
                 "ResidentField::releaseStaging() needs the whole recordUpload() before it");
    parts_->upload.release();
}

bool ResidentField::isStreamed() const
{
    return parts_->field.streaming != nullptr;
}

glm::dvec3 ResidentField::origin() const
{
    return parts_->field.shape.origin;
}

Aabb ResidentField::content() const
{
    return parts_->field.shape.content;
}

const field::Defaults& ResidentField::defaults() const
{
    return parts_->defaults;
}

VkDeviceSize ResidentField::deviceBytes() const
{
    return parts_->field.bytes();
}

VkDeviceSize ResidentField::stagingBytes() const
{
    return parts_->upload.bytes();
}

} // namespace sward::render
