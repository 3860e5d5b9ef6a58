#include "render/field/field_looks.h"

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

} // namespace

FieldLooks looksOf(const field::FieldView& field)
{
    FieldLooks looks;
    looks.mayFold = anyLook(field, [](const shared::Species& look) { return look.fold > 0.0f; });
    looks.mayHaveOrgans =
        anyLook(field, [](const shared::Species& look) { return look.organKinds > 0; });
    if (field.species.empty())
        return looks;
    const std::uint32_t shape = field.species[0].look.shape;
    if (!anyLook(field, [&](const shared::Species& look) { return look.shape != shape; }))
        looks.onlyShape = shape;
    return looks;
}

} // namespace sward::render
