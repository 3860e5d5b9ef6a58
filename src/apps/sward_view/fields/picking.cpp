#include "apps/sward_view/fields/picking.h"

#include "shaders/shared/culling.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sward::view {
namespace {

constexpr double slack = 1.5;        ///< [pixels] tolerance beside a blade
constexpr int curvePieces = 8;       ///< number of test points per blade
constexpr double behindGround = 1.0; ///< [heights] tolerance for blades rooted behind the hit
constexpr int patchesAtMost = 256;   ///< most patches read back; farther ones have tiny blades

struct Candidate {
    double entered; ///< [m]
    std::uint32_t patch;
};

// Patches whose box the line of sight enters, nearest first.
std::vector<Candidate> candidatesOf(const field::FieldView& field, const Sight& sight,
                                    double farthest)
{
    std::vector<Candidate> found;
    const glm::dvec3 from = sight.eye - field.origin;
    const glm::dvec3 inverse = 1.0 / sight.direction;
    for (std::uint32_t i = 0; i < field.patches.size(); ++i) {
        const shared::Patch& cell = field.patches[i];
        if (cell.bladeCount == 0)
            continue;
        Aabb box;
        box.add(cell.boundsLow);
        box.add(cell.boundsHigh);
        const std::optional<double> entered = presentation::enters(box, from, inverse);
        if (entered && *entered <= farthest)
            found.push_back({*entered, i});
    }
    std::sort(found.begin(), found.end(),
              [](const Candidate& a, const Candidate& b) { return a.entered < b.entered; });
    return found;
}

// Distance along the line of sight at which it passes a blade, or infinity.
double passes(const Sight& sight, const render::FieldRenderer::BladeRecord& record,
              const shared::Blade& blade)
{
    for (int i = 0; i <= curvePieces; ++i) {
        const double t = static_cast<double>(i) / curvePieces;
        const glm::dvec3 place = (1.0 - t) * (1.0 - t) * record.root +
                                 2.0 * t * (1.0 - t) * record.v1 + t * t * record.v2;
        const glm::dvec3 arm = place - sight.eye;
        const double along = glm::dot(arm, sight.direction);
        if (along <= 0.0)
            continue;
        const double aside = glm::length(arm - along * sight.direction);
        // The nearest test point is at most half a piece away.
        const double reach = 0.5 * static_cast<double>(blade.width) +
                             slack * along * sight.pixelSize +
                             0.5 * static_cast<double>(blade.height) / curvePieces;
        if (aside <= reach)
            return along;
    }
    return std::numeric_limits<double>::infinity();
}

// The blade's id in an export of its own field.
std::uint64_t idOf(const PickedBlade& picked, const ShownField& shown)
{
    const field::FieldView& own = shown.group.members()[picked.source.member].view;
    const std::size_t index = own.patches[picked.source.patch].firstBlade + picked.place;
    return own.idOf(index);
}

} // namespace

Sight sightThrough(const render::Camera& camera, glm::vec2 pixel, glm::vec2 size)
{
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    glm::dvec3 right = glm::cross(ahead, glm::dvec3(camera.up));
    right = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 up = glm::cross(right, ahead);
    const auto height = static_cast<double>(size.y);
    const double pixelSize =
        2.0 * std::tan(0.5 * glm::radians(static_cast<double>(camera.fovY))) / height;
    const glm::dvec2 place = (glm::dvec2(pixel) - 0.5 * glm::dvec2(size)) * pixelSize;
    return {camera.eye, glm::normalize(ahead + right * place.x - up * place.y), pixelSize};
}

std::optional<PickedBlade> pickBlade(const render::FieldRenderer& renderer, const ShownField& shown,
                                     const Sight& sight, bool onlyDrawn)
{
    const field::FieldView& field = shown.view;
    const std::optional<presentation::GroundSurface::Hit> hit =
        shown.ground.hit(sight.eye, sight.direction);
    double nearest = std::numeric_limits<double>::infinity();
    const double farthest = hit ? hit->distance : nearest;
    std::optional<PickedBlade> picked;
    int read = 0;
    for (const Candidate& candidate : candidatesOf(field, sight, farthest + behindGround)) {
        if (candidate.entered > nearest || ++read > patchesAtMost)
            break;
        const shared::Patch& cell = field.patches[candidate.patch];
        const auto records = renderer.dumpPatch(field, candidate.patch);
        // A non-resident patch has no records and was not drawn.
        for (std::uint32_t i = 0; i < records.size(); ++i) {
            if (onlyDrawn && records[i].cullResult != shared::cullResultDrawn)
                continue;
            const shared::Blade blade =
                shared::unpackBlade(field.blades[cell.firstBlade + i], cell);
            const double passed = passes(sight, records[i], blade);
            if (passed < nearest &&
                passed < farthest + behindGround * static_cast<double>(blade.height)) {
                nearest = passed;
                picked = PickedBlade{candidate.patch, i, shown.group.sourceOf(candidate.patch),
                                     blade, records[i]};
            }
        }
    }
    if (picked)
        picked->now.id = idOf(*picked, shown);
    return picked;
}

PickedBlade lookAgain(const render::FieldRenderer& renderer, const ShownField& shown,
                      const PickedBlade& picked)
{
    PickedBlade again = picked;
    const auto records = renderer.dumpPatch(shown.view, picked.patch);
    if (records.empty())
        return picked; // no longer resident
    again.now = records.at(picked.place);
    again.now.id = picked.now.id;
    return again;
}

} // namespace sward::view
