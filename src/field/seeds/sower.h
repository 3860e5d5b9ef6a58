#pragma once

#include "field/field.h"
#include "field/seeds/near_clumps.h"
#include "field/seeds/seeds.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sward::field {

/// Which blades are sown: those whose roots lie in [low, high) and within `radius` of `centre`, and
/// whose ranks are from `from` to below `share`. Places are relative to the field's origin [m].
struct SowRegion {
    /// No bound.
    static constexpr double unbounded = std::numeric_limits<double>::infinity();

    glm::dvec3 low{-unbounded}; ///< inclusive
    glm::dvec3 high{unbounded}; ///< exclusive
    glm::dvec3 centre{0.0};     ///< of a ball
    double radius = unbounded;  ///< of that ball
    float from = 0.0f;          ///< [0, 1]
    float share = 1.0f;         ///< [0, 1]

    bool holds(glm::dvec3 place) const; ///< but for the ranks
    bool isBounded() const;             ///< holds() may be false

    /// Whether a box, or a 32 m cell, has a place in it, or almost.
    bool mayTouch(glm::dvec3 boxLow, glm::dvec3 boxHigh) const;
    bool mayTouch(const std::array<std::int32_t, 3>& cell) const;
};

/// Blades of one octree cell of 32 m / 2^level whose ranks belong to that level, at most
/// shared::maxPatchBlades. A cell with more has several such parts, in order of rank.
struct SownPatch {
    std::uint32_t level = 0;
    std::array<std::uint32_t, 3> place{}; ///< of the octree cell in the 32 m cell
    std::uint32_t first = 0;              ///< blade
    std::uint32_t count = 0;              ///< blades, ribbons included
    float rankLow = 0.0f;                 ///< rank of its first stalk
    float rankHigh = 0.0f;                ///< rank of its last stalk
};

/// What grows in a 32 m cell.
struct SownCell {
    std::array<std::int32_t, 3> cell{};
    float heightStep = 0.0f;        ///< [m] of its packed blades
    std::vector<SownPatch> patches; ///< by level, then by Morton order, then by rank
    UninitializedVector<shared::PackedBlade> blades;
    UninitializedVector<BladeKey> keys; ///< one a blade
};

class Sower;

/// What all blades of a 32 m cell share.
struct CellSurroundings {
    /// Both must outlive it.
    CellSurroundings(const SeedCell& cell, const Sower& sower);

    /// Box of the places of a piece [units].
    struct Box {
        glm::ivec3 low;
        glm::ivec3 high; ///< inclusive
    };

    std::vector<shared::SowWave> waves; ///< Sower::wavesAt()
    shared::SowGround ground;           ///< Sower::groundAt()
    NearClumps clumps;
    std::vector<Box> boxes;   ///< of its pieces
    float heightScale = 1.0f; ///< of its packed blades: the least shared::sowHeightScale()
};

/// Sows cells on the CPU by the functions of shaders/shared/sow, by which a device sows, too. The
/// result depends on the cell, the meadow and the region alone. Thread-safe.
class Sower {
public:
    /// `meadow` and `species` must outlive it. `origin` is that of the field.
    Sower(const SeedMeadow& meadow, std::span<const Species> species, glm::dvec3 origin);
    Sower(const Sower&) = delete; // its meadow refers to its species
    Sower& operator=(const Sower&) = delete;

    SownCell sow(const SeedCell& cell, const SowRegion& region) const;

    /// The same for several regions of a cell.
    SownCell sow(const SeedCell& cell, const CellSurroundings& around,
                 const SowRegion& region) const;

    /// The patch by which the blades of a sown patch are unpacked; nothing else is filled in.
    shared::Patch unpackingOf(const SownCell& cell, const SownPatch& patch) const;

    /// As the shaders read it, but for the place of the species.
    const shared::SowMeadow& meadow() const { return meadow_; }
    std::span<const shared::SowSpecies> species() const { return species_; }

    /// The same for the blades of a cell.
    shared::SowMeadow meadowAt(const CellSurroundings& around) const;

    /// Lattices of the slow waves at a cell, as shared::SowWaves.
    std::vector<shared::SowWave> wavesAt(const std::array<std::int32_t, 3>& cell) const;

    /// Up-vector of the ground at a cell.
    shared::SowGround groundAt(const std::array<std::int32_t, 3>& cell) const;

    /// As shared::SowTones.
    std::span<const std::uint32_t> tones() const { return tones_; }

    /// Ribbons on a stalk of each species, in order.
    std::span<const std::vector<shared::SowRibbon>> ribbons() const { return ribbons_; }

private:
    struct Ranked;

    std::vector<Ranked> candidatesOf(const SeedCell& cell, const CellSurroundings& around,
                                     const SowRegion& region) const;

    shared::SowMeadow meadow_ = {};
    std::vector<shared::SowSpecies> species_;
    double scale_;
    glm::dvec3 origin_;
    glm::dvec3 up_; ///< as SeedMeadow::up
    bool isRadial_;
    std::vector<std::uint32_t> tones_;
    std::vector<std::vector<shared::SowRibbon>> ribbons_; ///< of each species, in order
};

} // namespace sward::field
