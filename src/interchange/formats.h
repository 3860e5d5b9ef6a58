#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <filesystem>

namespace sward::interchange {

/// A format of exports.
struct Format {
    const char* extension; ///< ".glb"
    void (*write)(const field::FieldView&, const std::filesystem::path&, const ExportSettings&,
                  Progress&);
    bool hasGround; ///< can include the drawn ground, and what engines need
    bool isCompact; ///< has a compact form
};

/// The format of a file, by its extension: .glb .ply .usda .csv. Throws Error{unsupported} for
/// another one, Error{usage} if `settings` want what it cannot hold, or two forms at once.
const Format& formatOf(const std::filesystem::path& path, const ExportSettings& settings);

} // namespace sward::interchange
