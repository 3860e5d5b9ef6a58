#pragma once

#include "field/field.h"
#include "gpu/context/context.h"
#include "render/resident/placed_field.h"
#include "render/streaming/streaming.h"
#include "render/viewer/field_renderer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// The state of every blade after the last frame, in file order; then of the sown ones, whose units
/// are grown again for their keys. Waits for the device. `places`: of each stored blade on the
/// device, if they are not in file order.
std::vector<FieldRenderer::BladeRecord> readBlades(const gpu::DeviceContext& context,
                                                   const PlacedField& blades,
                                                   const field::FieldView& field,
                                                   std::span<const std::uint32_t> places);

/// The same for one patch, whose blades are in memory at `parts`; empty without parts. Leaves the
/// width factors unset.
std::vector<FieldRenderer::BladeRecord>
readPatch(const gpu::DeviceContext& context, const PlacedField& blades,
          const field::FieldView& field, std::uint32_t patch, std::span<const BladePart> parts);

/// The blades of a sown patch in memory, `cell`, and their state. Leaves ids and width factors
/// unset.
SownDump readSown(const gpu::DeviceContext& context, const PlacedField& blades,
                  const field::FieldView& field, const shared::Patch& cell);

} // namespace sward::render
