#pragma once

#include "core/bounds.h"
#include "field/seeds/sow_unit.h"
#include "render/field/blade_record.h"
#include "shaders/shared/blade.h"

#include <cstdint>
#include <vector>

namespace sward::render {

/// A patch of blades that are sown and in memory (decision 0045).
struct SownPatch {
    field::SowUnit unit;     ///< that it belongs to
    std::uint32_t patch = 0; ///< of its unit
    Aabb bounds;             ///< of its blades, relative to the field's origin [m]
};

/// The blades of a SownPatch, and their state in the last frame.
struct SownDump {
    std::vector<shared::Blade> blades; ///< relative to the field's origin
    std::vector<BladeRecord> records;  ///< without ids and `lodWidth`
};

} // namespace sward::render
