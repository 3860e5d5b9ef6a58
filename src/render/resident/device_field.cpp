#include "render/resident/device_field.h"

#include "render/sowing/sown_view.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sward::render {
namespace {

/// Nodes of the patch tree that bound the number of rounds of a frame: about 20 µs.
constexpr std::size_t nodesOfBound = 2048;

BakedBlades bladesOf(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                     const field::FieldView& field, const DeviceField::Settings& settings)
{
    if (settings.edited)
        return {context, upload, field, settings.edited->tables(), settings.edited->placed(field)};
    if (settings.stored)
        return {context, upload, field, settings.sown->tables(), settings.stored->placed(field)};
    if (settings.sown)
        return {context, upload, field, settings.sown->tables(), field.blades};
    return {context, upload, field, settings.walkStart, settings.pages};
}

} // namespace

DeviceField::DeviceField(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                         gpu::BufferUpload& upload, const field::FieldView& field, GrassCover made,
                         Settings settings)
    : cover(std::move(made))
    , blades(bladesOf(context, upload, field, settings))
    , shape{field.origin, field.bounds(), blades.bladeSize(), settings.exposure, {}}
    , looks(looksOf(field))
{
    if (settings.boundsRounds)
        bound.emplace(field, nodesOfBound);
    if (blades.isPaged())
        streaming =
            std::make_unique<Streaming>(context, shaders, field, blades, settings.streaming);
    if (settings.sown) {
        shape.sown = {.room = double(settings.sown->tables().bladeRoom),
                      .bladesPerArea = bladesPerArea(*field.seeds->meadow),
                      .stored = field.seeds->meadow->stored,
                      .blades = double(field.blades.size()) /
                                std::max(field.seeds->meadow->stored, 1e-12),
                      .levels = double(field.seeds->meadow->levels)};
        sowing = std::make_unique<Sowing>(context, shaders, field, std::move(settings.sown),
                                          std::move(settings.stored), settings.sowing);
        storedWidening = static_cast<float>(field.seeds->meadow->storedWidening);
    }
    if (settings.edited)
        edits = std::make_unique<ResidentEdits>(context, shaders, std::move(settings.edited),
                                                ResidentEdits::Field{blades, cover, shape},
                                                settings.framesInFlight);
}

void DeviceField::apply(const field::Delta& delta)
{
    if (sowing) {
        checkDelta(delta, shape.origin);
        const SownDelta sown(delta, storedWidening);
        const PlaceRange corners = cover.apply(sown.delta());
        sowing->apply(sown.delta(),
                      {.values = cover.values(), .corners = corners, .buffer = &cover.buffer()});
        for (const field::CellChange& change : delta.cells)
            if (!change.patches.empty()) {
                shape.content.add(change.patches.front().boundsLow);
                shape.content.add(change.patches.front().boundsHigh);
            }
        return;
    }
    edits->apply(delta);
    if (bound)
        for (const field::CellChange& change : delta.cells)
            bound->replace(change.cell, change.patches);
}

VkDeviceSize DeviceField::bytes() const
{
    return blades.bytes() + cover.bytes() + (streaming ? streaming->bytes() : 0) +
           (edits ? edits->bytes() : 0) + (sowing ? sowing->bytes() : 0);
}

} // namespace sward::render
