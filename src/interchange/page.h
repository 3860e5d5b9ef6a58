#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <cstdint>
#include <filesystem>

namespace sward::interchange {

/// Writes a page that shows a field in a browser (docs/web.md): a folder with `index.html`, the
/// script `sward.js`, `sow.wasm` for a field with seeds, `field.cover`, the leaf area of the field
/// as shaders read it with hashes of itself and of the blades, and `poster.jpg` if the settings
/// have one. The caller puts the field beside them, as `field.sward`. Existing files are replaced
/// if the settings allow it; others of the folder stay. Returns the bytes written. Throws
/// Error{io}.
std::uint64_t writePage(const field::FieldView& field, const std::filesystem::path& folder,
                        const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
