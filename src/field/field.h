#pragma once

#include "core/bounds.h"
#include "core/uninitialized.h"
#include "field/defaults.h"
#include "field/display_ground.h"
#include "field/organs.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/species.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::field {

struct SharedSeeds;
struct SeedsView;

/// Origin of a blade: the triangle of the input and the candidate number on it.
struct BladeKey {
    std::uint32_t triangle = 0;  ///< of the input, from 0
    std::uint32_t candidate = 0; ///< number of the candidate, from 0
};

/// The blade's stable id outside the field: a hash of triangle and candidate alone. It is below
/// 2⁵³, so that every program can read it as a number.
std::uint64_t bladeId(BladeKey key);

/// Names of the shapes of a blade, shared::shapeTriangleTip … shapeLeaf.
inline constexpr std::array<std::string_view, shared::namedShapes> shapeNames{
    "triangle-tip", "quad", "triangle", "quadratic", "dandelion", "leaf"};

/// A kind of grass.
struct Species {
    std::string name;               ///< of the species
    shared::Species look = {};      ///< as shaders see it
    std::vector<Organ> organs = {}; ///< of a compound plant; see numberOrgans()
};

/// A baked meadow: the only data that the offline half passes to the running half.
struct Field {
    glm::dvec3 origin{0.0};             ///< world = origin + position
    std::vector<shared::Patch> patches; ///< [0] is the root of the tree; parents before children
    UninitializedVector<shared::PackedBlade> blades; ///< patch after patch, in progressive order
    UninitializedVector<BladeKey> keys;              ///< one per blade
    std::vector<Species> species;                    ///< 1 to 8
    DisplayGround ground;                            ///< drawn below the blades
    double thinned = 1.0; ///< [1, 1e9] leaf area of the meadow relative to that of the blades
    std::shared_ptr<const SharedSeeds> seeds; ///< what bears; null: the blades are all there are
    Defaults defaults;    ///< initial settings
    std::string provenance = "{}"; ///< JSON: tool version, input hash, settings, seed
    std::string copyright;         ///< shown to users
};

inline constexpr double maxThinned = 1e9; ///< largest Field::thinned

/// A verified field that is stored elsewhere, usually in a mapped file.
struct FieldView {
    glm::dvec3 origin{0.0};                      ///< world = origin + position
    std::span<const shared::Patch> patches;      ///< as Field::patches
    std::span<const shared::PackedBlade> blades; ///< as Field::blades
    std::span<const BladeKey> keys;              ///< one per blade
    std::span<const Species> species;            ///< 1 to 8
    const DisplayGround* ground = nullptr;       ///< never null
    double thinned = 1.0;                        ///< as Field::thinned
    const SeedsView* seeds = nullptr;            ///< as Field::seeds
    const Defaults* defaults = nullptr;          ///< never null
    const std::string* provenance = nullptr;     ///< never null
    const std::string* copyright = nullptr;      ///< never null

    /// Box of everything visible, relative to the origin; empty if there is nothing.
    Aabb bounds() const;

    /// Whether a blade is a ribbon on the stalk of a compound plant.
    bool isRibbon(std::size_t blade) const;

    /// Id of a blade by its index: bladeId() of its key, or the index if the field has no keys.
    std::uint64_t idOf(std::size_t blade) const;
};

FieldView viewOf(const Field& field);

/// Patch index of each blade.
std::vector<std::uint32_t> patchOfBlades(const FieldView& field);

} // namespace sward::field
