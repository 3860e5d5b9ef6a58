#include "render/resident/resident_ids.h"

#include "render/field/edited_field.h"
#include "render/sowing/sowing.h"

#include <utility>

namespace sward::render {

std::shared_ptr<const std::vector<std::uint64_t>> residentIdsOf(const DeviceField& own,
                                                                const field::FieldView& field)
{
    if (!own.edits && !own.sowing)
        return nullptr;
    const std::vector<std::uint32_t> places =
        own.edits ? own.edits->field().placesOf(field) : own.sowing->placesOf(field);
    std::vector<std::uint64_t> ids(own.blades.placeCount(), 0);
    for (std::size_t i = 0; i < field.blades.size(); ++i)
        if (const std::size_t place = places.empty() ? i : places[i]; place < ids.size())
            ids[place] = field.idOf(i);
    if (own.sowing)
        for (const SownTables::Resident& resident : own.sowing->residents()) {
            const field::GrownUnit grown = own.sowing->grownAgain(resident.unit);
            for (std::size_t p = 0; p < grown.patches.size(); ++p)
                for (std::uint32_t i = 0; i < grown.patches[p].bladeCount; ++i)
                    ids[resident.patches[p].firstBlade + i] =
                        field::bladeId(grown.keys[grown.patches[p].firstBlade + i]);
        }
    return std::make_shared<const std::vector<std::uint64_t>>(std::move(ids));
}

} // namespace sward::render
