#include "render/edits/resident_edits.h"

#include <utility>

namespace sward::render {

ResidentEdits::ResidentEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                             std::unique_ptr<EditedField> edited, const Field& field,
                             std::uint32_t framesInFlight)
    : context_(&context)
    , field_(field)
    , edits_(context, shaders, std::move(edited), field.cover, framesInFlight)
    , replaced_(framesInFlight)
    , framesInFlight_(framesInFlight)
{
}

void ResidentEdits::apply(const field::Delta& delta)
{
    isBehind_ = true;
    edits_.apply(delta);
}

void ResidentEdits::begin()
{
    if (!isBehind_)
        return;
    field_.blades.update(*context_, edits_.field().tables(), replaced_.waiting());
    followEdit(field_.shape, edits_.field());
    isBehind_ = false;
}

void ResidentEdits::record(const gpu::Recording& commands,
                           std::span<const BladeStates* const> states, std::uint32_t settledAt,
                           std::uint32_t slot)
{
    replaced_.record(commands, slot);
    edits_.record(commands, field_.blades, states, settledAt, slot);
}

} // namespace sward::render
