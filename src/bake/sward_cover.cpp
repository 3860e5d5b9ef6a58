#include "bake/sward_cover.h"

#include "bake/filter/species_mix.h"
#include "core/exact_math.h"
#include "field/defaults.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/shape.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

constexpr int stiffnessSteps = 8;
constexpr int curveSteps = 32;
constexpr double maxDensity = 1e6; // [1/m²]

// Plan of a blade of height and width 1 at rest: the integral of its width over the horizontal way
// of its curve. The blade leans along its front, and its width is level.
double planAtRest(const SpeciesTraits& species, double stiffness)
{
    const field::Defaults defaults;
    const double b = 1.0 - stiffness;
    const double gravity = defaults.gravityStrength;
    const double forward = shared::forwardShare * gravity;
    const double recovery = defaults.recovery * (1.0 - 0.25 * b);
    // The tip rests where gravity and recovery balance: relaxTurn() without wind.
    const glm::vec3 pull(b * forward, 0.0, recovery - b * gravity);
    const shared::Pose pose = shared::poseBlade(glm::vec3(0.0f, 0.0f, 1.0f),
                                                glm::vec3(1.0f, 0.0f, 0.0f), glm::normalize(pull));
    double plan = 0.0;
    float before = 0.0f;
    for (int i = 1; i <= curveSteps; ++i) {
        const float t = float(i) / curveSteps;
        const float x = shared::bezierPoint(glm::vec3(0.0f), pose.v1, pose.v2, t).x;
        const glm::vec2 edges = shared::outlineAt(species.look.shape, species.look.tipThreshold,
                                                  (float(i) - 0.5f) / curveSteps);
        plan += double(edges.y - edges.x) * double(std::abs(x - before));
        before = x;
    }
    return plan;
}

double middle(glm::dvec2 range)
{
    return 0.5 * (range.x + range.y);
}

} // namespace

BladeCover coverOf(const SpeciesTraits& species)
{
    const double area = middle(species.height) * middle(species.width);
    double plan = 0.0;
    for (int i = 0; i < stiffnessSteps; ++i) {
        const double share = (i + 0.5) / stiffnessSteps;
        plan += planAtRest(species, species.stiffness.x +
                                        share * (species.stiffness.y - species.stiffness.x));
    }
    return {area * double(shared::outlineArea(species.look.shape, species.look.tipThreshold)),
            area * plan / stiffnessSteps};
}

BladeCover coverOf(const Meadow& meadow)
{
    const SpeciesMix mix(meadow);
    const SpeciesShares& shares = mix.evenShares();
    BladeCover mean;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot) {
        const BladeCover one = coverOf(meadow.species[slot]);
        const double share = shares.total > 0.0 ? shares.share[slot] / shares.total : 0.0;
        mean.leafArea += share * one.leafArea;
        mean.plan += share * one.plan;
    }
    return mean;
}

double closedDensity(const Meadow& meadow)
{
    const double plan = coverOf(meadow).plan;
    const double wanted = -std::log(1.0 - meadow.closedCover);
    // Rounded, since the last bits of a logarithm differ between CPUs.
    return std::clamp(std::round(wanted / plan), 1.0, maxDensity);
}

} // namespace sward::bake
