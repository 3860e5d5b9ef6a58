#include "render/field/baked_blades.h"

#include "core/error.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

/// Indices of the non-empty patches, in the order of their blades.
std::vector<std::uint32_t> nonEmptyPatchesOf(const field::FieldView& field)
{
    std::vector<std::uint32_t> nonEmptyPatches;
    for (std::size_t i = 0; i < field.patches.size(); ++i)
        if (field.patches[i].bladeCount > 0)
            nonEmptyPatches.push_back(static_cast<std::uint32_t>(i));
    std::sort(nonEmptyPatches.begin(), nonEmptyPatches.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                  return field.patches[a].firstBlade < field.patches[b].firstBlade;
              });
    return nonEmptyPatches;
}

/// The indices into `nonEmptyPatches` at which the search for a blade's patch begins.
std::vector<std::uint32_t> firstNonEmptyPatchesOf(const field::FieldView& field,
                                                  const std::vector<std::uint32_t>& nonEmptyPatches)
{
    std::vector<std::uint32_t> first;
    std::uint32_t place = 0;
    for (std::size_t blade = 0; blade < field.blades.size(); blade += shared::nonEmptyPatchStride) {
        const auto end = [&] {
            const shared::Patch& cell = field.patches[nonEmptyPatches[place]];
            return std::size_t(cell.firstBlade) + cell.bladeCount;
        };
        while (end() <= blade)
            ++place;
        first.push_back(place);
    }
    return first;
}

} // namespace

BakedBlades::BakedBlades(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                         const field::FieldView& field, std::uint32_t walkStart,
                         std::uint32_t pages)
    : patchSizes_(field.patches)
{
    if (field.blades.size() > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::unsupported, "the field has {} blades; one view draws at most {}",
             field.blades.size(), std::numeric_limits<std::uint32_t>::max());
    const std::vector<std::uint32_t> nonEmptyPatches = nonEmptyPatchesOf(field);
    const std::vector<std::uint32_t> firstNonEmptyPatches =
        firstNonEmptyPatchesOf(field, nonEmptyPatches);
    bladeCount_ = static_cast<std::uint32_t>(field.blades.size());
    placeCount_ = pages == 0 ? bladeCount_ : pages * shared::pageBlades;
    patchCount_ = static_cast<std::uint32_t>(field.patches.size());
    nonEmptyPatchCount_ = static_cast<std::uint32_t>(nonEmptyPatches.size());
    entryCount_ = nonEmptyPatchCount_;

    // In the file's layout.
    blades_ =
        allocate(context, "field/blades", placeCount_ * sizeof(shared::PackedBlade), pages > 0);
    patches_ = allocate(context, "field/patches", field.patches.size_bytes());
    nonEmptyPatches_ =
        allocate(context, "field/nonEmptyPatches", nonEmptyPatches.size() * sizeof(std::uint32_t));
    firstNonEmptyPatches_ = allocate(context, "field/first nonEmptyPatches",
                                     firstNonEmptyPatches.size() * sizeof(std::uint32_t));
    describeField(context, upload, field);
    if (pages == 0) {
        upload.toBuffer(blades_, field.blades);
    } else {
        const std::vector<std::uint32_t> nowhere(
            gpu::groupsFor(field.blades.size(), shared::pageBlades), shared::noPlace);
        pages_ = allocate(context, "field/pages", nowhere.size() * sizeof(std::uint32_t));
        upload.toBuffer(pages_, std::span<const std::uint32_t>(nowhere));
    }
    upload.toBuffer(patches_, field.patches);
    upload.toBuffer(nonEmptyPatches_, std::span<const std::uint32_t>(nonEmptyPatches));
    upload.toBuffer(firstNonEmptyPatches_, std::span<const std::uint32_t>(firstNonEmptyPatches));
    tree_.emplace(context, upload, field, walkStart, pages > 0);
    bytes_ += tree_->bytes();
}

BakedBlades::BakedBlades(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                         const field::FieldView& field, const FieldTables& tables,
                         std::span<const shared::PackedBlade> placed)
    : isEditable_(true)
    , patchSizes_(*tables.sizes)
{
    count(tables);
    blades_ = allocate(context, "field/blades", placeCount_ * sizeof(shared::PackedBlade));
    patches_ = allocate(context, "field/patches", tables.patches.size_bytes());
    nonEmptyPatches_ = allocate(context, "field/nonEmptyPatches", tables.entries.size_bytes());
    firstNonEmptyPatches_ =
        allocate(context, "field/first nonEmptyPatches", tables.firstEntries.size_bytes());
    describeField(context, upload, field);
    upload.toBuffer(blades_, placed);
    upload.toBuffer(patches_, tables.patches);
    upload.toBuffer(nonEmptyPatches_, tables.entries);
    upload.toBuffer(firstNonEmptyPatches_, tables.firstEntries);
    tree_.emplace(context, upload, tables);
    bytes_ += tree_->bytes();
}

void BakedBlades::count(const FieldTables& tables)
{
    bladeCount_ = tables.bladeCount;
    placeCount_ = tables.bladeRoom;
    patchCount_ = static_cast<std::uint32_t>(tables.patches.size());
    nonEmptyPatchCount_ = tables.nonEmptyPatches;
    entryCount_ = tables.entryEnd;
    patchSizes_ = *tables.sizes;
}

void BakedBlades::update(const gpu::DeviceContext& context, const FieldTables& tables,
                         OutgrownBuffers& outgrown)
{
    count(tables);
    const auto fit = [&](gpu::Buffer& buffer, const char* name, VkDeviceSize bytes) {
        if (bytes <= buffer.bytes())
            return;
        bytes_ -= buffer.bytes();
        gpu::Buffer former = std::exchange(buffer, allocate(context, name, bytes));
        outgrown.push_back({std::move(former), buffer.get()});
    };
    fit(blades_, "field/blades", placeCount_ * sizeof(shared::PackedBlade));
    fit(patches_, "field/patches", tables.patches.size_bytes());
    fit(nonEmptyPatches_, "field/nonEmptyPatches", tables.entries.size_bytes());
    fit(firstNonEmptyPatches_, "field/first nonEmptyPatches", tables.firstEntries.size_bytes());
    bytes_ -= tree_->bytes();
    tree_->update(context, tables, outgrown);
    bytes_ += tree_->bytes();
}

void BakedBlades::describeField(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                                const field::FieldView& field)
{
    bladeSize_ = field::meanBladeSize(field);
    areaFactor_ = field::areaFactor(field);
    std::vector<shared::Species> species;
    for (const field::Species& kind : field.species)
        species.push_back(kind.look);
    species.resize(shared::maxSpecies, species.empty() ? shared::Species{} : species.front());
    species_ = allocate(context, "field/species", species.size() * sizeof(shared::Species));
    upload.toBuffer(species_, std::span<const shared::Species>(species));
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    if (!organs.empty()) {
        organs_ = allocate(context, "field/organs", organs.size() * sizeof(shared::Organ));
        upload.toBuffer(organs_, std::span<const shared::Organ>(organs));
    }
}

gpu::Buffer BakedBlades::allocate(const gpu::DeviceContext& context, const char* name,
                                  VkDeviceSize bytes, bool isFilledByCopyQueue)
{
    bytes_ += bytes;
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
             .isFilledByCopyQueue = isFilledByCopyQueue}};
}

void BakedBlades::describe(shared::Frame& frame) const
{
    frame.blades = blades_.address();
    frame.patches = patches_.address();
    frame.pages = pages_.address();
    frame.species = species_.address();
    frame.organs.address = organs_.address();
    frame.view.areaFactor = areaFactor_;
    frame.patchCount = patchCount_;
    frame.bladeCount = bladeCount_;
}

} // namespace sward::render
