#include "bake/whole/field_header.h"

#include "bake/patches/display_ground.h"
#include "bake/sample/surface_sampler.h"
#include "core/json/json_text.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <utility>

namespace sward::bake {
namespace {

// Initial viewer settings for this ground.
field::Defaults defaultsFor(const BakeSettings& settings, double scale)
{
    field::Defaults defaults;
    const auto lengths = static_cast<float>(scale);
    defaults.wind.waveLength *= lengths;
    defaults.wind.speed *= lengths;
    defaults.wind.gustSize *= lengths;
    if (settings.groundUp.radial) {
        defaults.attractor = settings.groundUp.centre;
        defaults.attractorBlend = 1.0f;
    } else {
        defaults.gravityDirection = -glm::vec3(settings.groundUp.direction);
        // The wind is horizontal: perpendicular to ground-up.
        const glm::vec3 up(settings.groundUp.direction);
        const glm::vec3 along =
            defaults.wind.direction - up * glm::dot(up, defaults.wind.direction);
        defaults.wind.direction = glm::normalize(along);
    }
    return defaults;
}

// What a field without blades has besides its ground.
field::Field frameOf(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const BakePlan& plan, const Report& report)
{
    field::Field field;
    field.origin = ground.origin;
    field.copyright = ground.copyright;
    field.species = fieldSpecies(settings.meadow);
    field.thinned = plan.plan.thinned;
    field.defaults = defaultsFor(settings, plan.plan.scale);
    field.provenance = provenanceOf(settings, report);
    return field;
}

} // namespace

std::string provenanceOf(const BakeSettings& settings, const Report& report)
{
    nlohmann::json object = {{"tool", "sward 0.1.0"},
                             {"input_hash", report.input.hash},
                             {"blade_scale", report.bladeScale},
                             {"settings", nlohmann::json::parse(toJson(settings))}};
    if (!report.input.mapSystem.empty())
        object["map_system"] = report.input.mapSystem;
    return jsonText(object);
}

std::vector<field::Species> fieldSpecies(const Meadow& meadow)
{
    std::vector<field::Species> list;
    for (const SpeciesTraits& species : meadow.species)
        list.push_back({species.name, species.look, species.organs});
    field::numberOrgans(list, "the meadow");
    return list;
}

field::Field fieldWithoutBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report)
{
    field::Field field = frameOf(ground, settings, plan, report);
    field.ground = displayGround(ground, masksByVertexColor(settings));
    return field;
}

field::Field fieldWithoutBlades(terrain::GroundMesh&& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report)
{
    field::Field field = frameOf(ground, settings, plan, report);
    field.ground = displayGround(std::move(ground), masksByVertexColor(settings));
    return field;
}

} // namespace sward::bake
