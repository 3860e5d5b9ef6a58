#include "bake/whole/warnings.h"

#include "bake/mask/map_mask.h"
#include "bake/paint/stroke_contact.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace sward::bake {
namespace {

// Shares of roots above which a warning is given.
constexpr double someUndersides = 0.01;
constexpr double maxUndersides = 0.75;
constexpr double hardlyAny = 0.01;

// The option that causes a rejection.
const char* optionOf(Reject reason)
{
    static constexpr std::array<const char*, rejectCount> options{"--spacing",
                                                                  "--mask",
                                                                  "alphaMode MASK",
                                                                  "--material",
                                                                  "--slope",
                                                                  "--altitude",
                                                                  "--border, --min-island",
                                                                  "--curvature",
                                                                  "--above-water",
                                                                  "--clearance",
                                                                  "--sky",
                                                                  "--occluder",
                                                                  "--exclude",
                                                                  "--paint"};
    return options[static_cast<std::size_t>(reason)];
}

std::uint64_t rejectedBy(const RootCounts& counts, Reject reason)
{
    return counts.rejected[static_cast<std::size_t>(reason)];
}

// "slope 120 (--slope), mask 30 (--mask)", largest first, without spacing, which no filter tests.
std::string reasonsOf(const RootCounts& counts)
{
    std::vector<Reject> reasons;
    for (std::size_t i = 0; i < rejectCount; ++i)
        if (counts.rejected[i] > 0 && static_cast<Reject>(i) != Reject::spacing)
            reasons.push_back(static_cast<Reject>(i));
    std::stable_sort(reasons.begin(), reasons.end(), [&](Reject a, Reject b) {
        return rejectedBy(counts, a) > rejectedBy(counts, b);
    });
    std::string text;
    for (const Reject reason : reasons)
        text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", nameOf(reason),
                            rejectedBy(counts, reason), optionOf(reason));
    return text.empty() ? "no filter (no ground bears grass, or zero blades were requested)" : text;
}

// Why there is no root before any filter, and which amount would give some.
std::string reasonOfNone(const Plan& plan)
{
    constexpr double some = 100.0;
    constexpr double maxDensity = 1e15; // of --density
    if (plan.area <= 0.0)
        return "no ground bears grass";
    if (plan.expected <= 0.0)
        return "none was asked for";
    const double density = some / plan.area;
    return fmt::format(
        "{:.2g} blades were expected on {:.3g} m² at {:.3g} per m²; {}--count {:.0f} "
        "gives some, --scale or --units enlarges the ground",
        plan.expected, plan.area, plan.expected / plan.area,
        density <= maxDensity ? fmt::format("--density {:.3g} or ", density) : "", some);
}

void warnAboutNone(const RootCounts& counts, const Report::Input& ground, const Plan& plan,
                   Diagnostics& diagnostics)
{
    if (counts.proposed == 0) {
        diagnostics.warn("no blade grows: {}", reasonOfNone(plan));
        return;
    }
    std::string where;
    if (rejectedBy(counts, Reject::altitude) + rejectedBy(counts, Reject::water) > 0)
        where = fmt::format("; the ground lies from {:.6g} to {:.6g} m along ground-up",
                            ground.altitudes.low, ground.altitudes.high);
    diagnostics.warn("no blade grows: {} roots proposed, rejected by {}{}", counts.proposed,
                     reasonsOf(counts), where);
}

void warnAboutUndersides(const RootCounts& counts, Diagnostics& diagnostics)
{
    const double share = double(counts.undersides) / double(counts.kept);
    if (share > maxUndersides)
        diagnostics.warn(
            "{:.1f} % of the blades grow on undersides; use --sides back for a mesh that "
            "is inside out, --up-axis z or -y for one that lies on its side or upside "
            "down",
            100.0 * share);
    else if (share > someUndersides)
        diagnostics.warn(
            "{:.1f} % of the blades grow on undersides; --slope 0:90 removes them; for a "
            "planet use --ground-up radial",
            100.0 * share);
}

// Warns of an option that rejects nothing; its mask, border or mesh is probably misplaced.
void warnAboutIdle(const RootCounts& counts, const Report::Input& ground,
                   const BakeSettings& settings, Diagnostics& diagnostics)
{
    if (settings.border.low > -unbounded && rejectedBy(counts, Reject::border) == 0)
        diagnostics.warn("--border rejects nothing: the ground that bears grass has no border "
                         "nearer than {:.6g} m",
                         settings.border.low);
    if (settings.excluded.empty() || rejectedBy(counts, Reject::excluded) > 0)
        return;
    const glm::dvec3 low = ground.low;
    const glm::dvec3 high = ground.high;
    for (const ExcludedArea& area : settings.excluded) {
        if (area.map != nullptr) {
            const terrain::MapBounds own = area.map->bounds();
            if (!(own.low.x <= own.high.x)) {
                diagnostics.warn("--exclude {}: has no areas", area.file);
                continue;
            }
            diagnostics.warn(
                "--exclude {}: excludes nothing; it lies from {:.8g} to {:.8g} m east and "
                "{:.8g} to {:.8g} m north, the ground from {:.8g} to {:.8g} and {:.8g} to {:.8g}",
                area.file, own.low.x, own.high.x, own.low.y, own.high.y, low.x, high.x, -high.z,
                -low.z);
        }
        if (area.mesh == nullptr)
            continue;
        const Aabb own = area.mesh->bounds();
        const glm::dvec3 ownLow = area.mesh->origin + glm::dvec3(own.low);
        const glm::dvec3 ownHigh = area.mesh->origin + glm::dvec3(own.high);
        diagnostics.warn("--exclude {}: excludes nothing; it lies from ({:.6g}, {:.6g}, {:.6g}) to "
                         "({:.6g}, {:.6g}, {:.6g}), the ground from ({:.6g}, {:.6g}, {:.6g}) to "
                         "({:.6g}, {:.6g}, {:.6g}); --units, --up-axis and --scale apply to both",
                         area.file, ownLow.x, ownLow.y, ownLow.z, ownHigh.x, ownHigh.y, ownHigh.z,
                         low.x, low.y, low.z, high.x, high.y, high.z);
    }
}

} // namespace

void warnAboutRoots(const RootCounts& counts, const Report::Input& ground,
                    const BakeSettings& settings, const Plan& plan, Diagnostics& diagnostics)
{
    if (counts.kept == 0) {
        warnAboutNone(counts, ground, plan, diagnostics);
        return;
    }
    const std::uint64_t asked = counts.proposed - rejectedBy(counts, Reject::spacing);
    if (double(counts.kept) < hardlyAny * double(asked))
        diagnostics.warn("only {:.2g} % of the roots are kept; rejected by {}",
                         100.0 * double(counts.kept) / double(asked), reasonsOf(counts));
    warnAboutUndersides(counts, diagnostics);
    warnAboutIdle(counts, ground, settings, diagnostics);
}

void warnOfStrokes(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   Diagnostics& diagnostics)
{
    const Strokes& strokes = settings.strokes;
    if (!strokes.empty()) {
        const Aabb own = ground.bounds();
        const glm::dvec3 low = ground.origin + glm::dvec3(own.low);
        const glm::dvec3 high = ground.origin + glm::dvec3(own.high);
        warnOfContacts(strokes.list, contactsOf(ground, settings.sides, strokes.list), 0,
                       "--paint " + strokes.file,
                       fmt::format("The ground lies from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, "
                                   "{:.6g}, {:.6g}); --move-strokes DISTANCE moves strokes onto it",
                                   low.x, low.y, low.z, high.x, high.y, high.z),
                       diagnostics);
    }
    const bool raises =
        std::any_of(strokes.list.begin(), strokes.list.end(), [](const Stroke& stroke) {
            return stroke.kind == StrokeKind::add ||
                   (stroke.kind == StrokeKind::set && stroke.value > 1.0);
        });
    if (raises && settings.spread != Spread::uniform)
        diagnostics.warn("--paint {}: strokes thin Poisson disks, but cannot add any; --sampling "
                         "uniform can",
                         strokes.file);
}

} // namespace sward::bake
