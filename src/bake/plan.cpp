#include "bake/plan.h"

#include "bake/blades/clumps.h"
#include "bake/sample/poisson_region.h"
#include "bake/tile_region.h"
#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

constexpr double defaultDensity = 300.0; // [1/m²] at scale 1
constexpr double clampedBlades = 20e6;
constexpr double fullScaleWidth = 20.0; // [m]
constexpr double smallestScale = 1e-6;

// Positions in a patch have 16 bits on each axis.
constexpr double stepsPerPatch = 65535.0;

// Bytes of one blade in the file: 16 packed, about 4 for its key, plus its share of the patch.
constexpr double bytesPerBlade = 21.0;

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
        plan.density = defaultDensity / (plan.scale * plan.scale);
        plan.expected = plan.density * area;
        const double limit = std::min(clampedBlades, double(settings.maxBlades));
        if (plan.expected > limit) {
            diagnostics.warn(
                "{:.4g} m² at {:.4g} blades per m² would be {:.4g} blades and {:.3g} GB; "
                "density lowered to {:.4g} per m² for {:.4g} blades (request more with "
                "--density or --count)",
                area, plan.density, plan.expected, plan.expected * bytesPerBlade * 1e-9,
                limit / area, limit);
            plan.density = limit / area;
            plan.expected = limit;
        }
    }
    if (settings.spread != Spread::uniform && !settings.spacing && !settings.count)
        plan.spacing = plan.density > 0.0 ? std::sqrt(yield / plan.density) : 0.0;
    if (plan.expected > double(settings.maxBlades))
        fail(ErrorKind::input,
             "{:.6g} blades would grow on {:.4g} m², more than --max-blades {}; about {:.3g} GB",
             plan.expected, area, settings.maxBlades, plan.expected * bytesPerBlade * 1e-9);
    return plan;
}

} // namespace sward::bake
