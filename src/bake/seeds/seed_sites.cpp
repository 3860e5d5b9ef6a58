#include "bake/seeds/seed_sites.h"

#include "bake/blades/ground_color.h"
#include "bake/blades/wide_variation.h"
#include "bake/filter/occluder_test.h"
#include "bake/filter/up_vector.h"
#include "bake/ground/drawn_colors.h"
#include "core/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::bake {
namespace {

std::uint32_t fractionOf(double x, std::uint32_t whole)
{
    return static_cast<std::uint32_t>(std::clamp(x, 0.0, 1.0) * double(whole) + 0.5);
}

std::uint32_t byteOf(double x)
{
    return fractionOf(x, 255);
}

DAabb boxOfTriangle(const terrain::GroundMesh& ground, std::size_t triangle)
{
    DAabb box;
    for (glm::length_t corner = 0; corner < 3; ++corner)
        box.add(glm::dvec3(ground.positions[ground.triangles[triangle][corner]]));
    return box;
}

// Boxes around bare triangles. Blades change there: bare ground may bury or shade them, or be a
// path.
BoxTree bareBoxes(const terrain::GroundMesh& ground, double reach)
{
    std::vector<DAabb> boxes;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        if (ground.bears[t] == 0) {
            DAabb& box = boxes.emplace_back(boxOfTriangle(ground, t));
            box.low -= reach;
            box.high += reach;
        }
    return BoxTree(std::move(boxes));
}

// Keeps the part of a crease within a box; false if there is none.
bool cutToBox(terrain::ConvexCrease& crease, const DAabb& box)
{
    const glm::dvec3 from(crease.from);
    const glm::dvec3 along = glm::dvec3(crease.to) - from;
    double first = 0.0;
    double last = 1.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) {
            if (from[axis] < box.low[axis] || from[axis] > box.high[axis])
                return false;
            continue;
        }
        const double low = (box.low[axis] - from[axis]) / along[axis];
        const double high = (box.high[axis] - from[axis]) / along[axis];
        first = std::max(first, std::min(low, high));
        last = std::min(last, std::max(low, high));
    }
    if (first > last)
        return false;
    if (first > 0.0)
        crease.from = glm::vec3(from + first * along);
    if (last < 1.0)
        crease.to = glm::vec3(from + last * along);
    return true;
}

bool hasMaskOf(const Habitat& habitat)
{
    return !habitat.masks.empty();
}

} // namespace

SeedSites::SeedSites(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
                     const field::SeedMeadow& meadow, RootFilter& filter,
                     const terrain::SurfaceQuery* rays, const terrain::SurfaceFeatures& features)
    : ground_(ground)
    , settings_(settings)
    , meadow_(meadow)
    , filter_(filter)
    , rays_(rays)
    , scale_(scale)
    , colorsAreMask_(masksByVertexColor(settings))
    , fitsOverhangs_(settings.meadow.fitsOverhangs && rays != nullptr &&
                     (settings.exposureRays > 0 || settings.clearance > 0.0))
    , baseColors_(drawnBaseColors(ground, colorsAreMask_))
    , paths_(ground, settings, filter, &features, scale)
    , creases_(features.creases, creaseReach(settings.meadow, scale),
               settings.meadow.edges.creaseBlend)
    , bare_(bareBoxes(ground, bareReach(settings, scale)))
{
    if (rays != nullptr && settings.exposureRays > 0)
        sky_.emplace(ground, settings, settings.rayLength * scale, *rays,
                     settings.meadow.edges.occluderReach * scale);
    filtersVary_ = !settings.masks.empty() || !settings.excluded.empty() || needsGreen(settings) ||
                   !settings.border.holds(-unbounded, unbounded) || settings.clearance > 0.0 ||
                   !settings.sky.holds(0.0, 1.0) ||
                   std::any_of(settings.meadow.species.begin(), settings.meadow.species.end(),
                               [](const SpeciesTraits& one) { return hasMaskOf(one.habitat); });
    if (filter.painting() != nullptr)
        painted_ = PaintedParts(*filter.painting(), settings.strokes);
}

void SeedSites::repaint(const Strokes& strokes)
{
    filter_.repaint(strokes);
    painted_ =
        filter_.painting() != nullptr ? PaintedParts(*filter_.painting(), strokes) : PaintedParts();
}

bool SeedSites::isCutOut(std::uint32_t triangle) const
{
    return ground_.materials[ground_.materialOf[triangle]].alphaCutoff > 0.0f;
}

double SeedSites::bareReach(const BakeSettings& settings, double scale)
{
    const EdgeTraits& edges = settings.meadow.edges;
    return std::max(2.0 * edges.occluderReach, edges.pathReach) * scale + 0.01;
}

bool SeedSites::varies(std::uint32_t triangle, const DAabb& part) const
{
    return filtersVary_ || isCutOut(triangle) ||
           ground_.materials[ground_.materialOf[triangle]].image !=
               terrain::GroundMaterial::noImage ||
           bare_.meets(part);
}

SeedRays SeedSites::raysAt(const RootSample& root) const
{
    SeedRays found;
    found.isBlocked = filter_.obstacle(root).has_value();
    if (sky_)
        found.around = sky_->around(root);
    if (!fitsOverhangs_)
        return found;
    constexpr double used = 0.95; // as BladeGrower
    const glm::dvec3 place(root.position);
    const glm::dvec3 up = upVector(creases_.normalAt(root),
                                   settings_.groundUp.at(ground_.origin + place), settings_.align);
    const double wanted = double(meadow_.highest) / used;
    if (wanted > settings_.clearance && !rays_->isClear(place, up, wanted, root.triangle))
        found.room = rays_->clearance(place, up, wanted, root.triangle) / wanted;
    return found;
}

shared::SeedConditions SeedSites::at(const RootSample& root, const SeedRays& rays,
                                     const PaintedPart& painted) const
{
    const Stand stand = filter_.standAt(root, painted.look);
    const PaintedLook paint = painted.look ? filter_.lookAt(root) : PaintedLook();
    const EdgeTraits& edges = settings_.meadow.edges;
    const auto foot = static_cast<double>(rays.around.foot);
    const PathEdges::Edge path = paths_.at(root, stand.weight);
    const double trodden = path.nearness * (1.0 - foot) * (1.0 - stand.raised);
    const double height = paint.height * (1.0 + (edges.occluderHeight - 1.0) * foot) *
                          (1.0 - (1.0 - edges.pathHeight) * trodden);
    // A stroke turns blades after a path has.
    const double turned = std::min(std::sqrt(glm::dot(paint.lean, paint.lean)), 1.0);
    const double stiffness = (1.0 - 0.6 * edges.pathLean * trodden) * (1.0 - 0.6 * turned);
    const glm::dvec3 lean = path.away * (edges.pathLean * trodden * (1.0 - turned)) + paint.lean;
    const double dried = edges.occluderDryness * foot;
    const glm::vec3 tint = groundColor(ground_, root, baseColors_, colorsAreMask_);

    // Weights above 0 stay above 0.
    std::uint32_t density = rays.isBlocked ? 0 : fractionOf(stand.weight, 65535);
    if (density == 0 && stand.weight > 0.0 && !rays.isBlocked)
        density = 1;
    const auto component = [](double x) {
        return static_cast<std::uint32_t>(std::clamp(x, -1.0, 1.0) * 127.0 + 127.5);
    };
    // 255 says that nothing is above; a lower number is rounded down.
    const auto room = rays.room >= 1.0 ? 255U : static_cast<std::uint32_t>(rays.room * 254.0);
    shared::SeedConditions conditions = {};
    conditions.growth = density | byteOf(double(rays.around.exposure)) << 16U |
                        byteOf(dried + paint.dryness * (1.0 - dried)) << 24U;
    conditions.look = byteOf(double(tint.x)) | byteOf(double(tint.y)) << 8U |
                      byteOf(double(tint.z)) << 16U | byteOf(stiffness) << 24U;
    const std::size_t species = settings_.meadow.species.size();
    const bool isSown = painted.species && species > 1 && !meadow_.isMixed;
    const PaintedSpecies own =
        isSown ? filter_.painting()->speciesAt(root.position, root.normal) : PaintedSpecies();
    const double vigour = meadow_.isMixed ? 1.0 : stand.vigour[0];
    conditions.size = std::min(static_cast<std::uint32_t>(height * 8192.0 + 0.5), 65535U) |
                      byteOf(vigour) << 16U | room << 24U;
    conditions.lean = component(lean.x) | component(lean.y) << 8U | component(lean.z) << 16U;
    for (std::size_t slot = 0; (meadow_.isMixed || isSown) && slot < species; ++slot) {
        const double total = std::max(stand.shares.total, 1e-9);
        const double share = isSown ? own.share[slot] : stand.shares.share[slot] / total;
        conditions.share[slot / 4] |= byteOf(share) << 8U * (slot % 4);
        conditions.vigour[slot / 4] |= byteOf(stand.vigour[slot]) << 8U * (slot % 4);
    }
    return conditions;
}

bool SeedSites::growsMore(const RootSample& root, double asks) const
{
    Reject ignored = Reject::paint;
    return filter_.painting()->mayChangeDensity(root.position) &&
           filter_.paintedDensity(root, 0.0, ignored) >= asks && !filter_.obstacle(root);
}

bool SeedSites::grows(const RootSample& root) const
{
    const double chance = uniform(settings_.seed, keyBits(keyOf(ground_, root)),
                                  static_cast<std::uint32_t>(Dimension::chance));
    Reject ignored = Reject::mask;
    return filter_.paintedDensity(root, chance, ignored) > chance && !filter_.obstacle(root);
}

std::uint32_t SeedSites::upAt(const RootSample& root) const
{
    const glm::dvec3 up = upVector(
        glm::dvec3(root.normal), settings_.groundUp.at(ground_.origin + glm::dvec3(root.position)),
        settings_.align);
    return pack(up);
}

std::uint32_t SeedSites::pack(glm::dvec3 unit)
{
    const auto component = [](double x) {
        return static_cast<std::uint32_t>(std::clamp(x, -1.0, 1.0) * 511.0 + 511.5);
    };
    return component(unit.x) | component(unit.y) << 10U | component(unit.z) << 20U;
}

std::vector<terrain::ConvexCrease> SeedSites::creasesNear(const DAabb& ground, DAabb cell) const
{
    // More than the reach, so that rounding of the ends turns no blade.
    cell.low -= 2.0 * creases_.reach();
    cell.high += 2.0 * creases_.reach();
    std::vector<terrain::ConvexCrease> found;
    for (const std::size_t index : creases_.near(ground)) {
        terrain::ConvexCrease crease = creases_[index];
        if (cutToBox(crease, cell))
            found.push_back(crease);
    }
    return found;
}

std::int32_t SeedSites::moistureOf(std::uint32_t triangle, glm::dvec3 place) const
{
    if (settings_.meadow.wideVariation <= 0.0)
        return 0;
    const double moisture =
        WideVariation::moistureOfGround(ground_, settings_, scale_, rays_, triangle, place);
    return static_cast<std::int32_t>(
        std::floor(std::ldexp(std::clamp(moisture, -2.0, 2.0), 14) + 0.5));
}

} // namespace sward::bake
