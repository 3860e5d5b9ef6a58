#include "apps/sward_view/fields/picking.h"

#include "shaders/shared/culling.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace sward::view {
namespace {

constexpr double slack = 1.5;        ///< [pixels] tolerance beside a blade
constexpr int curvePieces = 8;       ///< number of test points per blade
constexpr double behindGround = 1.0; ///< [heights] tolerance for blades rooted behind the hit
constexpr int patchesAtMost = 256;   ///< most patches read back; farther ones have tiny blades

struct Candidate {
    double entered = 0.0;                    ///< [m]
    std::uint32_t patch = 0;                 ///< of the field
    const render::SownPatch* sown = nullptr; ///< instead of that
};

// Patches whose box the line of sight enters, nearest first.
std::vector<Candidate> candidatesOf(const field::FieldView& field,
                                    std::span<const render::SownPatch> sown, const Sight& sight,
                                    double farthest)
{
    std::vector<Candidate> found;
    const glm::dvec3 from = sight.eye - field.origin;
    const glm::dvec3 inverse = 1.0 / sight.direction;
    const auto add = [&](const Aabb& box, Candidate candidate) {
        const std::optional<double> entered = presentation::enters(box, from, inverse);
        if (!entered || *entered > farthest)
            return;
        candidate.entered = *entered;
        found.push_back(candidate);
    };
    for (std::uint32_t i = 0; i < field.patches.size(); ++i) {
        const shared::Patch& cell = field.patches[i];
        if (cell.bladeCount == 0)
            continue;
        Aabb box;
        box.add(cell.boundsLow);
        box.add(cell.boundsHigh);
        add(box, {.patch = i});
    }
    for (const render::SownPatch& patch : sown)
        add(patch.bounds, {.sown = &patch});
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.entered < b.entered; });
    return found;
}

// The blades of a candidate and their state; empty if they are not in memory.
render::SownDump dumpOf(const render::FieldRenderer& renderer, const field::FieldView& field,
                        const Candidate& candidate)
{
    if (candidate.sown != nullptr)
        return renderer.dumpSown(field, *candidate.sown);
    render::SownDump dump{.blades = {}, .records = renderer.dumpPatch(field, candidate.patch)};
    const shared::Patch& cell = field.patches[candidate.patch];
    for (std::uint32_t i = 0; i < dump.records.size(); ++i) {
        dump.blades.push_back(shared::unpackBlade(field.blades[cell.firstBlade + i], cell));
        // Among sown blades, stored ones are drawn as narrow as these.
        if (renderer.isSown())
            dump.blades.back().width /= static_cast<float>(field.seeds->meadow->storedWidening);
    }
    return dump;
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
    const std::vector<render::SownPatch> sown = renderer.sownPatches();
    for (const Candidate& candidate : candidatesOf(field, sown, sight, farthest + behindGround)) {
        if (candidate.entered > nearest || ++read > patchesAtMost)
            break;
        // A non-resident patch has no records and was not drawn.
        const auto [blades, records] = dumpOf(renderer, field, candidate);
        for (std::uint32_t i = 0; i < records.size(); ++i) {
            if (onlyDrawn && records[i].cullResult != shared::cullResultDrawn)
                continue;
            const double passed = passes(sight, records[i], blades[i]);
            if (passed >= nearest ||
                passed >= farthest + behindGround * static_cast<double>(blades[i].height))
                continue;
            nearest = passed;
            picked = PickedBlade{.patch = candidate.patch,
                                 .place = i,
                                 .source = {},
                                 .sown = {},
                                 .blade = blades[i],
                                 .now = records[i]};
            if (candidate.sown != nullptr)
                picked->sown = PickedSown{*candidate.sown, {}};
        }
    }
    if (picked && picked->sown) {
        picked->sown->key = renderer.keyOf(picked->sown->patch, picked->place);
        picked->now.id = field::bladeId(picked->sown->key);
    } else if (picked) {
        picked->source = shown.group.sourceOf(picked->patch);
        picked->now.id = idOf(*picked, shown);
    }
    return picked;
}

PickedBlade lookAgain(const render::FieldRenderer& renderer, const ShownField& shown,
                      const PickedBlade& picked)
{
    PickedBlade again = picked;
    const auto records = picked.sown ? renderer.dumpSown(shown.view, picked.sown->patch).records
                                     : renderer.dumpPatch(shown.view, picked.patch);
    if (records.empty())
        return picked; // no longer in memory
    again.now = records.at(picked.place);
    again.now.id = picked.now.id;
    return again;
}

} // namespace sward::view
