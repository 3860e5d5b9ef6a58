#pragma once

#include "interchange/tiles/tile_tree.h"

#include <cstdint>
#include <filesystem>
#include <map>

namespace sward::interchange {

/// Levels of one subtree file.
inline constexpr std::uint32_t subtreeLevels = 4;

/// Which tiles of an implicit octree exist, and whether they have content.
class TileAvailability {
public:
    /// Parents are to be added, too.
    void add(const TileNumber& tile, bool hasContent);

    /// Levels that hold tiles; at least 1.
    std::uint32_t levels() const { return levels_; }

    /// Writes subtrees/LEVEL/X/Y/Z.subtree below `folder` for each subtree that holds a tile (3D
    /// Tiles 1.1, section 7.2: binary, version 1). Throws Error{io}.
    void write(const std::filesystem::path& folder) const;

private:
    using Key = std::array<std::uint32_t, 4>; // level, x, y, z
    std::map<Key, bool> tiles_;
    std::uint32_t levels_ = 1;
};

} // namespace sward::interchange
