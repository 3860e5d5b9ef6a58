#pragma once

#include "field/field.h"
#include "interchange/instances.h"
#include "interchange/tiles/earth_bend.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sward::interchange {

/// Number of a tile of an implicit octree: level 0 is the root; x, y, z count along the axes of 3D
/// Tiles (x, −z and y of the field).
struct TileNumber {
    std::uint32_t level = 0;
    std::array<std::uint32_t, 3> at{};
};

/// A place [m] relative to the field's origin in the axes of 3D Tiles, whose z points upwards.
glm::dvec3 tilePlace(const glm::dvec3& place);

/// The inverse of tilePlace().
glm::dvec3 fieldPlace(const glm::dvec3& place);

/// A box that holds all roots, relative to the field's origin in the field's axes; empty without
/// any.
DAabb rootBounds(const field::FieldView& field);

/// A tile: the blades whose roots lie in a cube. Their patches are known to lie in it, or may.
struct Tile {
    TileNumber number;
    glm::dvec3 low{0.0};                 ///< corner [m], as tilePlace()
    double size = 0.0;                   ///< side [m]
    std::vector<std::uint32_t> subtrees; ///< patches that lie in it with all below them
    std::vector<std::uint32_t> partial;  ///< patches of which some own blades may lie in it
};

/// The octree of tiles over a field, flat or bent onto the Earth. Cubes of at most 32 m are cells
/// of the flat field's patch tree, so a tile's blades are mostly those of a patch and of what lies
/// below it.
class TileTree {
public:
    /// `bend` outlives the tree; null: flat.
    TileTree(const field::FieldView& field, const EarthBend* bend);

    /// A cube on multiples of 32 m that holds all roots.
    Tile root() const;

    /// Rooted blades in a tile, ribbons and stalks included.
    std::uint64_t bladesIn(const Tile& tile) const;

    /// Those of its eight parts that hold patches.
    std::vector<Tile> childrenOf(const Tile& tile) const;

    /// The instances in a tile whose ranks are below `share`, relative to `place` [m] from the
    /// field's origin. Throws as bladeOf() does, naming `source`.
    std::vector<Instance> instancesIn(const Tile& tile, float share, const glm::dvec3& place,
                                      const std::string& source) const;

private:
    glm::dvec3 placeOf(const glm::vec3& root) const;
    DAabb boxOf(const shared::Patch& patch) const;
    bool holds(const Tile& tile, std::size_t blade, const shared::Patch& patch) const;
    void addOwn(const Tile& tile, std::uint32_t patch, bool isWhole, float share,
                const glm::dvec3& place, const std::string& source,
                std::vector<Instance>& instances) const;
    void addSubtree(const Tile& tile, std::uint32_t patch, float share, const glm::dvec3& place,
                    const std::string& source, std::vector<Instance>& instances) const;
    void distribute(std::uint32_t patch, std::array<Tile, 8>& parts,
                    const glm::dvec3& middle) const;

    const field::FieldView& field_;
    const EarthBend* bend_;
    std::vector<DAabb> own_;            ///< of the roots of each patch, as tilePlace()
    std::vector<DAabb> below_;          ///< the same with all patches below it
    std::vector<std::uint64_t> counts_; ///< blades of each patch and below it
};

} // namespace sward::interchange
