#include "apps/sward_view/interface/picked_text.h"

#include "render/frame/wind_phase.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/wind.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::view {
namespace {

// Ordered as shared::cullResultDrawn ….
constexpr std::array<const char*, shared::cullResultCount> cullResultTexts{
    "drawn",
    "culled with its patch",
    "culled: seen edge-on",
    "culled: outside of the view",
    "culled: too far away",
    "culled: behind the ground",
    "left out: thinner than a pixel"};

std::string vectorText(const glm::dvec3& v, int digits)
{
    return fmt::format("{:.{}f}  {:.{}f}  {:.{}f}", v.x, digits, v.y, digits, v.z, digits);
}

shared::Gravity gravityOf(const render::FrameSettings& settings, const glm::dvec3& origin)
{
    const field::Defaults& environment = settings.environment;
    shared::Gravity gravity = {};
    gravity.direction = glm::normalize(environment.gravityDirection);
    gravity.strength = environment.gravityStrength;
    gravity.attractor = glm::vec3(environment.attractor - origin);
    gravity.blend = environment.attractorBlend;
    gravity.forward = settings.forward;
    return gravity;
}

// Wind at the blade's tip, computed as in the update shader.
glm::vec3 windOn(const PickedBlade& picked, const field::FieldView& field,
                 const render::FrameSettings& settings, const glm::vec3& tip, double time)
{
    const std::vector<shared::WindSource> sources = render::blowing(settings.winds, field.origin);
    const Aabb bounds = field.bounds();
    const glm::vec3 size = bounds.isEmpty() ? glm::vec3(0.0f) : bounds.size();
    shared::Wind wind = render::together(sources, std::max({size.x, size.y, size.z}),
                                         render::latticeOf(field.origin, {}));
    render::moveTo(wind, settings.winds, time);
    return shared::windForce(wind, picked.blade.root, picked.blade.up, tip, 0.0f);
}

// What tells of a blade that no file has.
std::vector<PickedLine> sownLines(const PickedSown& sown)
{
    const field::SowUnit& unit = sown.patch.unit;
    return {{"Sown", fmt::format("level {}", unit.level),
             "The blade has been grown from the field's seeds; its rank is of this level"},
            {"Cell", fmt::format("{}  {}  {}", unit.cell[0], unit.cell[1], unit.cell[2]),
             "Number of its 32 m cell in the seeds"},
            {"Triangle", std::to_string(sown.key.triangle), "Triangle of the ground, from 0"},
            {"Candidate", std::to_string(sown.key.candidate),
             "Number of the blade on its triangle, from 0"}};
}

} // namespace

std::vector<PickedLine> pickedLines(const PickedBlade& picked, const ShownField& shown,
                                    const render::FrameSettings& settings, double time)
{
    const field::FieldView& field = shown.view;
    const shared::Blade& blade = picked.blade;
    const auto height = static_cast<double>(blade.height);
    const glm::vec3 tip = glm::vec3((picked.now.v2 - picked.now.root) / height);
    const glm::vec3 front = shared::frontOf(blade.up, shared::widthAxis(blade.up, blade.facing));
    const glm::vec3 gravity =
        shared::gravityAt(gravityOf(settings, field.origin), blade.root, front);
    const glm::vec3 wind = windOn(picked, field, settings, tip, time);
    const double bend =
        glm::degrees(std::acos(std::clamp(glm::dot(glm::normalize(tip), blade.up), -1.0f, 1.0f)));
    const std::string species = blade.species < field.species.size()
                                    ? field.species[blade.species].name
                                    : std::to_string(blade.species);
    std::vector<PickedLine> lines{
        {"Id", std::to_string(picked.now.id),
         "Identifier of the blade, as in sward export OUT.csv; of a sown one, of sward grow"},
        {"Cull result", cullResultTexts.at(picked.now.cullResult),
         "Result of culling in the last frame"},
        {"Species", species, "Species of the blade"},
        {"Root", vectorText(picked.now.root, 3), "World position of the root [m]"},
        {"Up", vectorText(glm::dvec3(blade.up), 3), "Up-vector of the blade"},
        {"Height", fmt::format("{:.3f} m", blade.height), "Length of the blade"},
        {"Width", fmt::format("{:.4f} m", blade.width), "Full width at the root"},
        {"Stiffness", fmt::format("{:.2f}", blade.stiffness), "Stiffness; 1: does not bend"},
        {"Bend", fmt::format("{:.0f}°", bend), "Angle of the tip from the up-vector"},
        {"Gravity", fmt::format("{:.2f} 1/s", glm::length(gravity)),
         "Pull of gravity, in heights per second"},
        {"Wind", fmt::format("{:.2f} 1/s", glm::length(wind)),
         "Pull of the wind, in heights per second"},
        {"Recovery",
         fmt::format("{:.2f} 1/s", settings.environment.recovery *
                                       (1.0f - 0.25f * (1.0f - blade.stiffness)) *
                                       std::max(1.0f - picked.now.eta, 0.1f)),
         "Rate of recovery"},
        {"Pressed", fmt::format("{:.2f}", picked.now.eta), "Strength of the last collision"}};
    const auto at = lines.begin() + 3;
    if (picked.sown) {
        const std::vector<PickedLine> sown = sownLines(*picked.sown);
        lines.insert(at, sown.begin(), sown.end());
        return lines;
    }
    lines.insert(at, {"Patch", std::to_string(picked.source.patch),
                      "Patch that owns the blade, in its field's tree"});
    if (shown.members.size() > 1)
        lines.insert(lines.begin(), {"Field", shown.members[picked.source.member]->name,
                                     "Field that the blade belongs to"});
    return lines;
}

} // namespace sward::view
