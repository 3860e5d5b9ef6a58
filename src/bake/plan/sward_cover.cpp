#include "bake/plan/sward_cover.h"

#include "bake/filter/species_mix.h"
#include "core/math/exact_math.h"
#include "field/defaults.h"
#include "shaders/shared/organ.h"
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

// A blade of this stiffness at rest, with its width axis along x: relaxTurn() without wind.
shared::PosedBlade restingBlade(double height, double stiffness)
{
    const field::Defaults defaults;
    const double b = 1.0 - stiffness;
    const double gravity = defaults.gravityStrength;
    const double forward = shared::forwardShare * gravity;
    const double recovery = defaults.recovery * (1.0 - 0.25 * b);
    // The tip rests where gravity and recovery balance.
    shared::Blade blade = {};
    blade.up = glm::vec3(0.0f, 0.0f, 1.0f);
    blade.height = static_cast<float>(height);
    const glm::vec3 axis = shared::widthAxis(blade.up, blade.facing);
    const glm::vec3 front = shared::frontOf(blade.up, axis);
    const glm::vec3 pull = float(b * forward) * front + float(recovery - b * gravity) * blade.up;
    const shared::Pose pose = shared::poseBlade(blade.up, front, glm::normalize(pull));
    return shared::posedBlade(blade,
                              shared::stateOf(blade.up, front, glm::normalize(pose.v2), 0.0f));
}

// Plan of a ribbon of width 1, seen along z: the sum over its curve of what each piece hides.
double planOf(const shared::PosedBlade& posed, const shared::Species& look)
{
    double plan = 0.0;
    glm::vec3 before = posed.v0;
    for (int i = 1; i <= curveSteps; ++i) {
        const glm::vec3 here =
            shared::bezierPoint(posed.v0, posed.v1, posed.v2, float(i) / curveSteps);
        const glm::vec2 edges =
            shared::outlineAt(look.shape, look.tipThreshold, (float(i) - 0.5f) / curveSteps);
        plan +=
            double(edges.y - edges.x) * double(std::abs(glm::cross(here - before, posed.axis).z));
        before = here;
    }
    return plan;
}

// Leaf area and plan of all ribbons of a plant.
BladeCover coverOf(const std::vector<field::Organ>& organs, const shared::PosedBlade& stalk)
{
    BladeCover sum;
    std::uint32_t number = 1;
    for (const field::Organ& organ : organs) {
        const shared::Organ device = field::deviceOrgan(organ);
        for (std::uint32_t i = 0; i < organ.count; ++i, ++number) {
            const shared::PosedBlade ribbon = shared::posedRibbon(stalk, device, number, i);
            const double width = double(organ.width) * double(ribbon.blade.height);
            sum.leafArea += width * double(ribbon.blade.height) *
                            double(shared::outlineArea(organ.look.shape, organ.look.tipThreshold));
            sum.plan += width * planOf(ribbon, organ.look);
        }
    }
    return sum;
}

double middle(glm::dvec2 range)
{
    return 0.5 * (range.x + range.y);
}

} // namespace

BladeCover coverOf(const SpeciesTraits& species)
{
    const double height = middle(species.height);
    const double width = middle(species.width);
    BladeCover sum;
    for (int i = 0; i < stiffnessSteps; ++i) {
        const double share = (i + 0.5) / stiffnessSteps;
        const shared::PosedBlade blade = restingBlade(
            height, species.stiffness.x + share * (species.stiffness.y - species.stiffness.x));
        const BladeCover ribbons = coverOf(species.organs, blade);
        sum.leafArea += ribbons.leafArea;
        sum.plan += width * planOf(blade, species.look) + ribbons.plan;
    }
    const double area =
        height * width * double(shared::outlineArea(species.look.shape, species.look.tipThreshold));
    return {area + sum.leafArea / stiffnessSteps, sum.plan / stiffnessSteps};
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

double bladesPerRoot(const Meadow& meadow)
{
    const SpeciesMix mix(meadow);
    const SpeciesShares& shares = mix.evenShares();
    double ribbons = 0.0;
    for (std::size_t slot = 0; slot < meadow.species.size(); ++slot)
        ribbons += double(shares.share[slot]) * field::ribbonsOf(meadow.species[slot].organs);
    return shares.total > 0.0 ? 1.0 + ribbons / shares.total : 1.0;
}

} // namespace sward::bake
