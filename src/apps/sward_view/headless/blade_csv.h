#pragma once

#include "render/viewer/field_renderer.h"

#include <filesystem>
#include <span>

namespace sward::view {

/// Writes the state of every blade, one row each, in the order of the field:
/// id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result.
/// Positions are in world space with nine decimals [m], other numbers have nine digits; the
/// cull result is "drawn" or the reason why not. Throws Error{io}.
void writeBladeCsv(std::span<const render::FieldRenderer::BladeRecord> blades,
                   const std::filesystem::path& path, bool overwrite);

} // namespace sward::view
