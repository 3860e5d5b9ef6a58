#pragma once

#include "shaders/shared/organ.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

struct BladeKey;
struct FieldView;
struct Species;

/// Ribbons of one kind on the stalk of a compound plant, as files state them. See shared::Organ.
struct Organ {
    std::string name;          ///< "leaf", "petal" …; for readers
    shared::Species look = {}; ///< colours and outline
    std::uint32_t count = 1;   ///< 1 to shared::maxRibbons
    glm::vec2 place{1.0f};     ///< [0, 1] along the stalk, of the first and the last ribbon
    glm::vec2 pitch{60.0f};    ///< [degrees] 0 to 180 from the stalk's direction
    glm::vec2 length{0.2f};    ///< (0, 1] in stalk lengths
    float width = 0.3f;        ///< (0, 2] in lengths of the ribbon
    float azimuth = 0.0f;      ///< [degrees] of the first one about the stalk
    float turn = 137.508f;     ///< [degrees] from each to the next; the golden angle
    float bend = 20.0f;        ///< [degrees] −180 to 180 from base to tip, outwards
    float variation = 0.2f;    ///< [0, 1] of angles and length
};

/// Whether two organs are drawn alike.
bool areAlike(const Organ& a, const Organ& b);

/// The same for the device.
shared::Organ deviceOrgan(const Organ& organ);

/// Reads the array of a species' organs, strictly; messages name `place`. Throws Error{input} if
/// they have more than shared::maxRibbons ribbons.
std::vector<Organ> parseOrgans(const nlohmann::json& list, const std::string& place);

/// The array that parseOrgans() reads back.
nlohmann::json organsJson(const std::vector<Organ>& organs);

/// Ribbons of a plant with these organs.
std::uint32_t ribbonsOf(const std::vector<Organ>& organs);

/// Sets the place of each species' organs in organTable(). Throws Error{input} naming `place` if
/// there are more than shared::maxOrganKinds.
void numberOrgans(std::vector<Species>& species, const std::string& place);

/// The organs of all species, in order.
std::vector<shared::Organ> organTable(std::span<const Species> species);

/// The same as shared functions read it; valid while `organs` lives.
shared::OrganTable viewOf(const std::vector<shared::Organ>& organs);

/// The outline, colours and mean length of a blade, a stalk or a ribbon.
struct BladePart {
    const shared::Species* look; ///< of the species, or of the organ
    float length;                ///< [m]; a ribbon's without its variation
};
BladePart partOf(const Species& species, const shared::Blade& blade);

/// Number of a field's blades without those on stalks: what users call its blades.
std::uint64_t rootedBlades(const FieldView& field);

/// Mean area (length times width) of the blades of compound plants and all others, relative to
/// their patches' middle height times middle width; 1 without compound plants. From a sample.
float areaFactor(const FieldView& field);

/// Key of a ribbon, from that of its stalk. Keys of different blades differ while candidates are
/// below 2²⁵.
BladeKey ribbonKey(BladeKey stalk, std::uint32_t number);

} // namespace sward::field
