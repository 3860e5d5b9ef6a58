#pragma once

#include "interchange/tiles/georeference.h"

#include <functional>
#include <optional>
#include <string>

namespace sward::interchange {

/// Settings of every export, besides field and file name.
struct ExportSettings {
    std::string source = "field"; ///< name of the field in messages
    bool overwrite = false;       ///< replace an existing file
    bool withGround = false;      ///< .glb only: the drawn ground beneath the blades
    bool forEngines = false;      ///< .glb only: groups in rank order; ranks, colours, wind
    bool compact = false;         ///< .glb, .usda: fewer bytes, with stated errors
    bool withIds = false;         ///< of compact exports: ids of the blades too
    std::string meshoptExtension = "EXT_meshopt_compression"; ///< or KHR_meshopt_compression
    std::optional<Geodetic> at{};    ///< 3D Tiles: where the world's origin lies on the Earth,
    std::optional<MapToEarth> map{}; ///< or where all its places lie
    /// Called after some millions of blades of a compact or tiled export: may take a mapped field
    /// out of memory.
    std::function<void()> rest{};
    std::string poster{};            ///< of a page: a JPEG that it shows before the field; or none
    std::string generator = "Sward"; ///< name and version of the program, stored in the file
};

} // namespace sward::interchange
