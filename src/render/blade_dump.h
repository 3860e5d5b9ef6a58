#pragma once

#include "field/field.h"
#include "gpu/context.h"
#include "render/field_buffers.h"
#include "render/field_renderer.h"
#include "render/streaming.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// The state of every blade as it was left by the last frame, in the order of the file. Waits for
/// the device.
std::vector<FieldRenderer::BladeRecord> readBlades(const gpu::DeviceContext& context,
                                                   const FieldBuffers& buffers,
                                                   const field::FieldView& field);

/// The same for one patch, whose blades lie in `parts` of the memory; none: nothing. Which of them
/// were drawn wider is not asked.
std::vector<FieldRenderer::BladeRecord>
readPatch(const gpu::DeviceContext& context, const FieldBuffers& buffers,
          const field::FieldView& field, std::uint32_t patch, std::span<const BladePart> parts);

} // namespace sward::render
