#pragma once

#include "interchange/blade_mesh.h"
#include "interchange/engine/drawn_look.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace sward::interchange {

/// Version of the object that engineExtras() makes. Readers refuse a newer one.
inline constexpr int engineExtrasVersion = 1;

/// What an engine needs to draw the exported blades as Sward does: the field's wind and gravity,
/// the leaf area by height, and each species' look and mean size (docs/exports.md). `means`: of the
/// field's species. Include from .cpp files only.
nlohmann::ordered_json engineExtras(const field::FieldView& field, const DrawnLooks& looks,
                                    const std::vector<MeanBlade>& means);

} // namespace sward::interchange
