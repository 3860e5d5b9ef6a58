#include "render/resident/instance_streaming.h"

#include "gpu/recording/barrier.h"

#include <algorithm>

namespace sward::render {

void InstanceStreaming::findFields(std::span<const PlacedField* const> instances)
{
    fields_.clear();
    for (const PlacedField* instance : instances)
        if (instance != nullptr &&
            (instance->streaming() != nullptr || instance->sowing() != nullptr) &&
            std::ranges::find(fields_, &instance->field()) == fields_.end())
            fields_.push_back(&instance->field());
}

void InstanceStreaming::record(const gpu::Recording& commands, std::uint32_t slot,
                               std::uint32_t settledAt, std::span<PlacedField* const> instances)
{
    findFields(instances);
    bool hasRecorded = false;
    for (const DeviceField* const field : fields_) {
        seen_.clear();
        states_.clear();
        for (const PlacedField* instance : instances) {
            if (instance == nullptr || &instance->field() != field)
                continue;
            seen_.insert(seen_.end(), instance->seen().begin(), instance->seen().end());
            states_.push_back(&instance->states());
        }
        if (seen_.empty())
            continue;
        if (field->streaming)
            field->streaming->choose(seen_, slot);
        else
            field->sowing->choose(seen_, slot);

        std::size_t first = 0;
        for (PlacedField* const instance : instances) {
            if (instance == nullptr || &instance->field() != field)
                continue;
            const std::size_t views = instance->seen().size();
            instance->thin(slot, std::span(seen_).subspan(first, views));
            first += views;
        }
        if (field->streaming)
            field->streaming->record(commands, slot, settledAt, states_);
        else
            field->sowing->record(commands, field->blades, states_, settledAt, slot);
        hasRecorded = true;
    }
    if (hasRecorded)
        gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
}

StreamingStats InstanceStreaming::stats(std::span<const PlacedField* const> instances)
{
    findFields(instances);
    StreamingStats sum;
    for (const DeviceField* const field : fields_) {
        const StreamingStats own =
            field->streaming ? field->streaming->stats() : field->sowing->stats();
        sum.pages += own.pages;
        sum.places += own.places;
        sum.residentPages += own.residentPages;
        sum.residentBlades += own.residentBlades;
        sum.wantedPages += own.wantedPages;
        sum.missingPages += own.missingPages;
        sum.nearestMissing = std::min(sum.nearestMissing, own.nearestMissing);
        sum.copiedBytes += own.copiedBytes;
        sum.thinning = std::max(sum.thinning, own.thinning);
        sum.isSettled = sum.isSettled && own.isSettled;
    }
    return sum;
}

} // namespace sward::render
