#include "field/field.h"

#include "core/random.h"
#include "field/seeds/seeds.h"

namespace sward::field {

std::uint64_t bladeId(BladeKey key)
{
    return mixBits((std::uint64_t(key.triangle) << 32 | key.candidate) + 0x9e3779b97f4a7c15ULL) >>
           11;
}

bool FieldView::isRibbon(std::size_t blade) const
{
    const std::uint32_t look = blades[blade].look;
    return look >> 24U != 0 && species[look >> 21U & 7U].look.organKinds > 0;
}

std::uint64_t FieldView::idOf(std::size_t blade) const
{
    return keys.empty() ? blade : bladeId(keys[blade]);
}

Aabb FieldView::bounds() const
{
    Aabb box;
    if (!patches.empty()) {
        box.add(patches[0].boundsLow);
        box.add(patches[0].boundsHigh);
    }
    for (const shared::GroundVertex& vertex : ground->vertices)
        box.add(vertex.position);
    return box;
}

FieldView viewOf(const Field& field)
{
    FieldView view;
    view.origin = field.origin;
    view.patches = field.patches;
    view.blades = field.blades;
    view.keys = field.keys;
    view.species = field.species;
    view.ground = &field.ground;
    view.thinned = field.thinned;
    if (field.seeds)
        view.seeds = &field.seeds->view;
    view.defaults = &field.defaults;
    view.provenance = &field.provenance;
    view.copyright = &field.copyright;
    return view;
}

std::vector<std::uint32_t> patchOfBlades(const FieldView& field)
{
    std::vector<std::uint32_t> result(field.blades.size());
    for (std::size_t p = 0; p < field.patches.size(); ++p) {
        const shared::Patch& patch = field.patches[p];
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
            result[patch.firstBlade + i] = static_cast<std::uint32_t>(p);
    }
    return result;
}

} // namespace sward::field
