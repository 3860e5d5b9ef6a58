#pragma once

#include "field/field.h"
#include "render/resident/device_field.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sward::render {

/// field::bladeId() of blades by their resident ids; null if those are numbers of the field, as
/// they are without edits and seeds. `field` is what `own` was made of, or has been edited to.
/// Units that are sown are grown again, some 10 ms each.
std::shared_ptr<const std::vector<std::uint64_t>> residentIdsOf(const DeviceField& own,
                                                                const field::FieldView& field);

} // namespace sward::render
