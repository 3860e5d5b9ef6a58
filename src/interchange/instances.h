#pragma once

#include "field/field.h"
#include "interchange/blade_groups.h"
#include "interchange/blade_mesh.h"
#include "interchange/engine/drawn_look.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sward::interchange {

/// A blade as an instance of its species' blade mesh.
struct Instance {
    shared::Blade blade;
    std::uint64_t id;   ///< field::bladeId, or the blade's index without keys
    glm::vec3 place;    ///< [m] relative to the group
    glm::quat rotation; ///< field::bladeRotation()
    glm::vec3 scale;    ///< [m] width, height, height; of a compound plant thrice its height
    float rank;         ///< [0, 1) in progressive order among the surrounding blades
    DrawnLook look;     ///< only if asked for
};

/// Blade `index` of patch `patch`. Throws Error{input} naming `source` if one of its numbers is not
/// finite.
shared::Blade bladeOf(const field::FieldView& field, std::uint32_t patch, std::size_t index,
                      const std::string& source);

/// Blade `index` of patch `patch`, which is no ribbon, with its place relative to `place` [m] from
/// the field's origin. Throws as bladeOf() does.
Instance instanceOf(const field::FieldView& field, std::uint32_t patch, std::size_t index,
                    const glm::dvec3& place, const std::string& source);

/// The instances of a group, patch after patch, each in progressive order. Throws as bladeOf()
/// does.
std::vector<Instance> instancesOf(const field::FieldView& field, const BladeGroup& group,
                                  const std::string& source);

/// Sorts by rank; of equal ranks the earlier instance stays first. Every prefix is then as evenly
/// spread as the field's own blades below that rank.
void orderByRank(std::vector<Instance>& instances);

/// Calls `rest` whenever some millions of blades have been read.
class BladeCounter {
public:
    explicit BladeCounter(std::function<void()> rest);
    void add(std::uint64_t blades);

private:
    std::function<void()> rest_;
    std::uint64_t count_ = 0; ///< since the last call
};

/// Means of each species' blades, ribbons left out; those of MeanBlade for a species without
/// blades. Calls `rest` (ExportSettings::rest) as BladeCounter does.
std::vector<MeanBlade> meanBlades(const field::FieldView& field,
                                  const std::function<void()>& rest = {});

} // namespace sward::interchange
