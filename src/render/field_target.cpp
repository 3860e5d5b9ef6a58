#include "render/field_target.h"

#include <algorithm>

namespace sward::render {
namespace {

/// Whether some species, or an organ of one, is so.
template <typename Is>
bool anyLook(const field::FieldView& field, Is is)
{
    return std::ranges::any_of(field.species, [&](const field::Species& kind) {
        return is(kind.look) || std::ranges::any_of(kind.organs, is, &field::Organ::look);
    });
}

/// TargetSettings::onlyShape.
std::uint32_t onlyShapeOf(const field::FieldView& field)
{
    if (field.species.empty())
        return shared::shapeCount;
    const std::uint32_t shape = field.species[0].look.shape;
    return anyLook(field, [&](const shared::Species& look) { return look.shape != shape; })
               ? shared::shapeCount
               : shape;
}

} // namespace

TargetSettings targetFor(const gpu::DeviceContext& context, const field::FieldView& field,
                         const FieldRendererSettings& wanted)
{
    const bool isForCpu = wanted.rastersForCpu.value_or(context.isCpu());
    return {.colorFormat = wanted.colorFormat,
            .samples = wanted.samples,
            .mayBePaged = wanted.deviceBytes > 0,
            .mayFold = anyLook(field, [](const shared::Species& look) { return look.fold > 0.0f; }),
            .mayHaveOrgans =
                anyLook(field, [](const shared::Species& look) { return look.organKinds > 0; }),
            .onlyShape = onlyShapeOf(field),
            .groupsDrawLarge = !isForCpu,
            .sortsTiles = isForCpu};
}

} // namespace sward::render
