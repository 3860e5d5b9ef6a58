#include "render/edits/field_edits.h"

#include "field/measure/distributions.h"

#include <utility>

namespace sward::render {

FieldEdits::FieldEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       std::unique_ptr<EditedField> edited, GrassCover& cover,
                       std::uint32_t framesInFlight)
    : edited_(std::move(edited))
    , cover_(&cover)
    , staged_(context, shaders, framesInFlight)
{
}

void FieldEdits::apply(const field::Delta& delta)
{
    const Edit edit = edited_->apply(delta);
    const PlaceRange corners = cover_->apply(delta);
    staged_.add(edit, edited_->tables(),
                {.values = cover_->values(), .corners = corners, .buffer = &cover_->buffer()});
}

void FieldEdits::record(const gpu::Recording& commands, const BakedBlades& baked,
                        std::span<const BladeStates* const> states, std::uint32_t settledAt,
                        std::uint32_t slot)
{
    staged_.record(commands, baked, states, settledAt, slot);
}

void followEdit(FieldShape& shape, const EditedField& edited)
{
    if (edited.bladeCount() == 0)
        return;
    field::FieldView now;
    now.patches = edited.patches();
    if (shape.blade.height <= 0.0f)
        shape.blade = field::meanBladeSize(now);
    shape.content.add(edited.patches()[0].boundsLow);
    shape.content.add(edited.patches()[0].boundsHigh);
}

} // namespace sward::render
