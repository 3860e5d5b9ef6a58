#include "render/resident/resident_field.h"

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/pipeline/shader_library.h"
#include "render/field/edited_field.h"
#include "render/resident/resident_ids.h"
#include "render/resident/resident_parts.h"
#include "render/sowing/sown_memory.h"
#include "render/sowing/sown_tables.h"
#include "render/sowing/sown_view.h"
#include "render/sowing/stored_cells.h"
#include "render/streaming/page_budget.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <limits>
#include <memory>
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

/// Bytes of a blade in memory, with the instances of the budget.
std::uint64_t bytesOfPlace(const FieldBudget& budget)
{
    const std::uint64_t perInstance = sizeof(shared::BladeState) +
                                      (budget.keepsMotion ? sizeof(shared::BladeState::turn) : 0) +
                                      budget.views * sizeof(shared::VisibleBlade);
    return sizeof(shared::PackedBlade) + budget.instances * perInstance;
}

/// Bytes of a field with room for `places` blades, and of the instances of its budget.
std::uint64_t bytesWith(const field::FieldView& field, const FieldBudget& budget,
                        std::uint64_t places)
{
    return treeBytes(field, budget.instances, budget.views) + places * bytesOfPlace(budget);
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

bool sows(const field::FieldView& field, const FieldBudget& budget)
{
    return budget.sownBytes > 0 && isSown(field);
}

DeviceField sownField(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                      const field::FieldView& stored, const FieldBudget& budget)
{
    const SownView whole(stored);
    const field::FieldView& field = whole.view();
    GrassCover cover(context, upload, field, whole.leafArea(), budget.isEditable,
                     whole.bladesPerStored());
    // The host needs memory, too.
    const std::uint64_t most = (budget.bytes > 0 ? budget.bytes : context.deviceLocalBytes()) / 2;
    const std::uint64_t bytes = std::min(budget.sownBytes, most);
    DeviceField::Settings settings{.framesInFlight = budget.framesInFlight};
    const SownMemory memory = SownMemory::of(bytes, bytesOfPlace(budget), budget.framesInFlight,
                                             budget.sowsOnDevice, context.isCpu());
    const std::uint32_t walkStart = context.isCpu() ? shared::walkStart : shared::walkStartOfGpu;
    if (budget.isEditable) {
        settings.sown = StoredCells::tablesFor(memory.room, field, walkStart);
        settings.stored = std::make_unique<StoredCells>(field, *settings.sown);
    } else {
        settings.sown = std::make_unique<SownTables>(field, memory.room, walkStart);
    }
    const std::uint64_t needed = cover.bytes() +
                                 bytesWith(field, budget, settings.sown->tables().bladeRoom) +
                                 (memory.device ? memory.device->deviceBytes() : 0);
    if (budget.bytes > 0 && needed > budget.bytes)
        fail(ErrorKind::runtime,
             "the field's {} stored blades, and room for those that it sows, need {} MiB; "
             "FieldBudget::bytes is {} MiB (FieldBudget::sownBytes may be less)",
             field.blades.size(), (needed >> 20) + 1, budget.bytes >> 20);
    settings.sowing = {.framesInFlight = budget.framesInFlight,
                       .threads = budget.sowThreads,
                       .waits = budget.waitsForDisk,
                       .device = memory.device};
    return {context,          gpu::ShaderLibrary(embedded::shaders()),
            upload,           field,
            std::move(cover), std::move(settings)};
}

DeviceField fieldOf(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                    const field::FieldView& field, const FieldBudget& budget)
{
    if (sows(field, budget))
        return sownField(context, upload, field, budget);
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
    if (isStreamed() || isSown())
        parts_->source = field;
}

ResidentField::ResidentField(const gpu::DeviceContext& context, const field::FieldView& field)
    : parts_(std::make_unique<Parts>(context, field, FieldBudget{.sownBytes = 0}))
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

bool ResidentField::isSown() const
{
    return parts_->field.sowing != nullptr;
}

std::shared_ptr<const std::vector<std::uint64_t>>
ResidentField::layerIds(const field::FieldView& field) const
{
    return residentIdsOf(parts_->field, field);
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
