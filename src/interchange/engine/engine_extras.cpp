#include "interchange/engine/engine_extras.h"

#include "field/measure/leaf_heights.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/look/leaf_finish.h"

#include <nlohmann/json.hpp>

#include <array>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Names of shared::finishOf().
constexpr std::array<const char*, 5> finishNames = {"grass", "broad", "petal", "stalk", "plain"};

ordered_json listOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

ordered_json windOf(const field::Wind& wind)
{
    return {{"direction", listOf(wind.direction)}, {"strength", wind.strength},
            {"wave_length_m", wind.waveLength},    {"speed_m_per_s", wind.speed},
            {"gust_size_m", wind.gustSize},        {"gustiness", wind.gustiness}};
}

ordered_json gravityOf(const field::FieldView& field)
{
    const field::Defaults& defaults = *field.defaults;
    return {{"direction", listOf(defaults.gravityDirection)},
            {"strength", defaults.gravityStrength},
            {"attractor_m", listOf(glm::vec3(defaults.attractor - field.origin))},
            {"blend", defaults.attractorBlend},
            {"forward", shared::forwardShare}};
}

// Sizes and number of the blades of each species.
struct SpeciesSize {
    double height = 0.0; // sums
    double width = 0.0;
    std::uint64_t count = 0;
};

std::vector<SpeciesSize> sizesOf(const field::FieldView& field)
{
    std::vector<SpeciesSize> sizes(field.species.size());
    for (const shared::Patch& patch : field.patches)
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
            if (field.isRibbon(i))
                continue;
            const shared::Blade blade = shared::unpackBlade(field.blades[i], patch);
            SpeciesSize& own = sizes[blade.species];
            own.height += double(blade.height);
            own.width += double(blade.width);
            ++own.count;
        }
    return sizes;
}

ordered_json speciesOf(const field::FieldView& field, const std::vector<MeanBlade>& means)
{
    const std::vector<SpeciesSize> sizes = sizesOf(field);
    ordered_json list = ordered_json::array();
    for (std::size_t s = 0; s < field.species.size(); ++s) {
        const field::Species& species = field.species[s];
        const SpeciesSize& size = sizes[s];
        const double count = size.count > 0 ? double(size.count) : 1.0;
        list.push_back({{"name", species.name},
                        {"blades", size.count},
                        {"plant", !species.organs.empty()},
                        {"mean_height_m", size.height / count},
                        {"mean_width_m", size.width / count},
                        {"mean_stiffness", means[s].stiffness},
                        {"root_color", listOf(species.look.rootColor)},
                        {"tip_color", listOf(species.look.tipColor)},
                        {"translucency", species.look.translucency},
                        {"gloss", species.look.gloss},
                        {"fold", species.look.fold},
                        {"finish", finishNames[shared::finishOf(species.look)]}});
    }
    return list;
}

} // namespace

ordered_json engineExtras(const field::FieldView& field, const DrawnLooks& looks,
                          const std::vector<MeanBlade>& means)
{
    const field::LeafHeights heights = field::leafHeightsOf(field);
    const shared::Cover cover = looks.cover();
    return {{"version", engineExtrasVersion},
            {"order", "rank"},
            {"wind", windOf(field.defaults->wind)},
            {"gravity", gravityOf(field)},
            {"recovery", field.defaults->recovery},
            {"leaves",
             {{"top_m", heights.top},
              {"projection", heights.projection},
              {"share_above", heights.above},
              {"undergrowth_color", listOf(cover.undergrowth)}}},
            {"species", speciesOf(field, means)}};
}

} // namespace sward::interchange
