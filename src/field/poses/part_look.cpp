#include "field/poses/part_look.h"

namespace sward::field {

PartLook partLookOf(const FieldView& field, const shared::OrganTable& organs,
                    const shared::Blade& blade)
{
    PartLook part{blade, field.species[blade.species].look};
    if (part.look.organKinds == 0)
        return part;
    if (const std::uint32_t number = blade.clump; number > 0) {
        std::uint32_t within = 0;
        part.look = organs.at[shared::organOf(organs, part.look, number, within)].look;
    }
    part.blade.clump = shared::plantKey(blade) % shared::driedClump;
    return part;
}

} // namespace sward::field
