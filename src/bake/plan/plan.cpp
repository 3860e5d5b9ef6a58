#include "bake/plan/plan.h"

#include "bake/blades/clumps.h"
#include "bake/ground/tile_region.h"
#include "bake/plan/sward_cover.h"
#include "bake/poisson/poisson_region.h"
#include "core/error.h"
#include "field/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

constexpr double maxWidening = 2.0;
constexpr double fullScaleWidth = 20.0; // [m]
constexpr double smallestScale = 1e-6;

// Positions in a patch have 16 bits on each axis.
constexpr double stepsPerPatch = 65535.0;

// Bytes of one blade in the file: 16 packed, about 4 for its key, plus its share of the patch.
constexpr double bytesPerBlade = 21.0;

// Chooses the density of a closed sward. Where the budget does not suffice, fewer blades are wider:
// up to twice, for they must not look like leeks. The ground shows the rest of the sward.
void closeSward(Plan& plan, const BakeSettings& settings, Diagnostics& diagnostics)
{
    plan.closedDensity = closedDensity(settings.meadow) / (plan.scale * plan.scale);
    plan.density = plan.closedDensity;
    plan.expected = plan.density * plan.area;
    // Ribbons of plants take as much memory as blades.
    const double perRoot = bladesPerRoot(settings.meadow);
    const bool isBudget = settings.budget <= settings.maxBlades;
    const double limit = double(std::min(settings.budget, settings.maxBlades)) / perRoot;
    const char* const option = isBudget ? "--budget" : "--max-blades";
    if (plan.expected <= limit)
        return;
    const double missing = plan.expected / limit;
    plan.widening = std::min(std::sqrt(missing), maxWidening);
    plan.thinned = std::min(missing / plan.widening, field::maxThinned);
    diagnostics.warn("a closed sward on {:.4g} m² is {:.4g} blades{} and {:.3g} GB; {} {} "
                     "leaves {:.4g} per m² of {:.4g}, {:.2g} times as wide, on ground in the "
                     "sward's colour ({} or --density allow more)",
                     plan.area, plan.expected,
                     perRoot > 1.0 ? fmt::format(" with {:.2g} ribbons each", perRoot - 1.0) : "",
                     plan.expected * perRoot * bytesPerBlade * 1e-9, option,
                     isBudget ? settings.budget : settings.maxBlades, limit / plan.area,
                     plan.closedDensity, plan.widening, option);
    plan.density = limit / plan.area;
    plan.expected = limit;
}

} // namespace

double automaticScale(double area)
{
    return std::clamp(std::sqrt(area) / fullScaleWidth, smallestScale, 1.0);
}

Plan planBake(double area, double extent, const BakeSettings& settings, Diagnostics& diagnostics)
{
    Plan plan;
    plan.area = area;
    plan.scale = settings.bladeScale ? *settings.bladeScale : automaticScale(area);
    const double yield = tuningOf(settings).yield;
    if (settings.meadow.clumpSize > 0.0)
        plan.clumpSpacing = clumpSpacing(settings.meadow.clumpSize * plan.scale, area);
    if (settings.count) {
        plan.expected = double(*settings.count);
    } else if (settings.spacing) {
        // Quantisation may move both roots of a pair by half a step along each axis.
        plan.spacing =
            *settings.spacing + std::sqrt(3.0) * std::min(extent, widestPatch) / stepsPerPatch;
        plan.density = yield / (plan.spacing * plan.spacing);
        plan.expected = plan.density * area;
    } else if (settings.density) {
        plan.density = *settings.density;
        plan.expected = plan.density * area;
    } else {
        closeSward(plan, settings, diagnostics);
    }
    if (settings.spread != Spread::uniform && !settings.spacing && !settings.count)
        plan.spacing = plan.density > 0.0 ? std::sqrt(yield / plan.density) : 0.0;
    // Ribbons take as much memory as blades; what closeSward() has limited may exceed it by an ulp.
    const double perRoot = bladesPerRoot(settings.meadow);
    if (plan.expected * perRoot > double(settings.maxBlades) * (1.0 + 1e-12))
        fail(ErrorKind::input,
             "{:.6g} blades{} would grow on {:.4g} m², more than --max-blades {}; about {:.3g} GB",
             plan.expected,
             perRoot > 1.0
                 ? fmt::format(" ({:.6g} with the ribbons of plants)", plan.expected * perRoot)
                 : "",
             area, settings.maxBlades, plan.expected * perRoot * bytesPerBlade * 1e-9);
    return plan;
}

} // namespace sward::bake
