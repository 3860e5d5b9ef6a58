#include "unit/render/light/traced_meadow.h"

#include "bake/bake.h"
#include "core/random.h"
#include "field/measure/leaf_area.h"
#include "field/measure/resting_blade.h"
#include "shaders/shared/ribbon.h"
#include "support/meshes.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::test {
namespace {

constexpr std::uint32_t segments = 6;
constexpr double farAway = 100.0; ///< [m] longer than any ray in a meadow
constexpr double skin = 3e-4;     ///< [m] so that a place does not shade itself

field::Field bakedMeadow(const std::string& meadow, double density, double side)
{
    bake::BakeSettings settings;
    settings.density = density;
    settings.bladeScale = 1.0;
    settings.exposureRays = 0;
    settings.meadow = bake::loadMeadow(meadow);
    // One kind of grass: the curve of leaf area is one for the whole field.
    settings.meadow.wideVariation = 0.0;
    Diagnostics diagnostics;
    Progress progress;
    return bake::bakeField(meshes::square(side), settings, 2, diagnostics, progress).field;
}

} // namespace

TracedMeadow::TracedMeadow(const std::string& meadow, double density, double side)
{
    const field::Field field = bakedMeadow(meadow, density, side);
    grid_ = field::leafAreaOf(field::viewOf(field));
    const shared::Cover cover = grid_.view();
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    std::vector<glm::uvec3> triangles;
    std::vector<std::pair<double, double>> areas;
    for (const shared::Patch& cell : field.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[cell.firstBlade + i], cell);
            addBlade(field, organs, blade, shared::grassAt(cover, blade.root), corners_, triangles,
                     areas);
        }

    // Leaf area by height over the ground.
    std::sort(areas.begin(), areas.end());
    double sum = 0.0;
    for (const auto& [height, area] : areas) {
        sum += area;
        heights_.push_back(height);
        below_.push_back(sum);
    }
    for (double& below : below_)
        below /= sum;
    leafArea_ = sum / (side * side);

    // The ground, far beyond the meadow.
    const auto first = static_cast<std::uint32_t>(corners_.size());
    const auto reach = static_cast<float>(farAway);
    std::vector<glm::vec3> corners = corners_;
    corners.insert(
        corners.end(),
        {{-reach, 0, -reach}, {-reach, 0, reach}, {reach, 0, reach}, {reach, 0, -reach}});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
    rays_.emplace(corners, triangles);
}

void TracedMeadow::addBlade(const field::Field& field, const std::vector<shared::Organ>& organs,
                            const shared::Blade& blade, glm::vec3 grass,
                            std::vector<glm::vec3>& corners, std::vector<glm::uvec3>& triangles,
                            std::vector<std::pair<double, double>>& areas)
{
    const field::FieldView view = field::viewOf(field);
    const shared::PosedBlade posed =
        field::restingBlade(view, field::viewOf(organs), field::calmOf(view), blade);
    const shared::Species& look = *field::partOf(field.species[blade.species], blade).look;
    shared::Ribbon ribbon = {};
    ribbon.v0 = posed.v0;
    ribbon.v1 = posed.v1;
    ribbon.v2 = posed.v2;
    ribbon.axis = posed.axis;
    ribbon.width = blade.width;
    ribbon.outline = shared::outlineOf(look.shape, look.tipThreshold, float(segments));
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const auto section = shared::crossSectionAt(ribbon, float(i) / float(segments), {}, 0.0f);
        corners.push_back(section.left);
        corners.push_back(section.right);
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        const std::uint32_t a = first + 2 * i;
        triangles.push_back({a, a + 1, a + 3});
        triangles.push_back({a, a + 3, a + 2});
        parts_.push_back({static_cast<std::uint32_t>(blades_.size()), float(i) / float(segments),
                          float(i + 1) / float(segments)});
        const glm::vec3 diagonal = corners[a + 3] - corners[a];
        const glm::vec3 other = corners[a + 2] - corners[a + 1];
        const float height =
            0.25f * (corners[a].y + corners[a + 1].y + corners[a + 2].y + corners[a + 3].y);
        areas.emplace_back(height, 0.5f * glm::length(glm::cross(diagonal, other)));
    }
    blades_.push_back({grass, look.translucency, posed.v0, posed.v1, posed.v2});
}

std::vector<SeenPlace> TracedMeadow::seenFrom(const MeadowView& view, double pixelSize,
                                              std::size_t pixels, std::size_t samples) const
{
    const double pitch = glm::radians(view.pitch);
    const glm::dvec3 forward(0.0, -std::sin(pitch), -std::cos(pitch));
    const glm::dvec3 upwards(0.0, std::cos(pitch), -std::sin(pitch));
    const glm::dvec3 right(1.0, 0.0, 0.0);
    // The middle pixel shows the origin.
    const double middle = view.eyeHeight / std::tan(pitch);
    const glm::dvec3 eye(0.0, view.eyeHeight, middle);
    const double reach = std::tan(glm::radians(view.fov) / 2.0);
    const double pixel = glm::radians(pixelSize);

    const shared::Cover cover = grid_.view();
    std::vector<SeenPlace> places;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double x = (2.0 * uniform(1, i, 0) - 1.0) * reach;
        const double y = (2.0 * uniform(1, i, 1) - 1.0) * reach;
        for (std::size_t k = 0; k < samples; ++k) {
            const std::size_t number = i * samples + k;
            const glm::dvec3 ray =
                glm::normalize(forward + (x + pixel * uniform(2, number, 0)) * right +
                               (y + pixel * uniform(2, number, 1)) * upwards);
            const terrain::SurfaceQuery::Hit hit = rays_->cast(eye, ray, farAway, 0.0);
            if (!hit.isHit() || hit.triangle / 2 >= parts_.size())
                continue;
            const Part& part = parts_[hit.triangle / 2];
            const Traced& blade = blades_[part.blade];
            const std::size_t first = std::size_t(hit.triangle / 2);
            const std::size_t a = 2 * (first + part.blade);
            const glm::dvec3 low = 0.5 * (glm::dvec3(corners_[a]) + glm::dvec3(corners_[a + 1]));
            const glm::dvec3 high =
                0.5 * (glm::dvec3(corners_[a + 2]) + glm::dvec3(corners_[a + 3]));
            const glm::dvec3 step = high - low;
            SeenPlace place;
            place.pixel = static_cast<std::uint32_t>(i);
            place.position = eye + hit.distance * ray;
            const double f =
                std::clamp(glm::dot(place.position - low, step) / glm::dot(step, step), 0.0, 1.0);
            place.along = double(part.low) + f * double(part.high - part.low);
            // Its width may be 0 at either end.
            const glm::dvec3 across = glm::dvec3(corners_[a + 1] - corners_[a]) +
                                      glm::dvec3(corners_[a + 3] - corners_[a + 2]);
            place.normal = glm::normalize(glm::cross(step, across));
            if (glm::dot(place.normal, ray) > 0.0)
                place.normal = -place.normal;
            place.height = place.position.y;
            place.leafArea = double(blade.grass.x);
            place.shareAbove = shareAbove(place.height);
            const float steps = shared::heightStepsPerMetre(cover, blade.grass);
            place.shaderShare =
                double(shared::leafShareAbove(cover, steps * static_cast<float>(place.height)));
            place.translucency = double(blade.translucency);
            places.push_back(place);
        }
    }
    return places;
}

bool TracedMeadow::seesSky(const glm::dvec3& place, const glm::dvec3& direction) const
{
    return !rays_->occluded(place, direction, farAway, skin);
}

double TracedMeadow::projection(const glm::dvec3& direction) const
{
    double sum = 0.0;
    double whole = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::size_t a = 2 * (i + parts_[i].blade);
        const glm::dvec3 across = glm::dvec3(corners_[a + 3]) - glm::dvec3(corners_[a]);
        const glm::dvec3 other = glm::dvec3(corners_[a + 2]) - glm::dvec3(corners_[a + 1]);
        const glm::dvec3 twice = glm::cross(across, other);
        sum += std::abs(glm::dot(twice, direction));
        whole += glm::length(twice);
    }
    return sum / whole;
}

double TracedMeadow::shareAbove(double height) const
{
    const auto at = std::lower_bound(heights_.begin(), heights_.end(), height);
    if (at == heights_.begin())
        return 1.0;
    return 1.0 - below_[static_cast<std::size_t>(at - heights_.begin()) - 1];
}

} // namespace sward::test
