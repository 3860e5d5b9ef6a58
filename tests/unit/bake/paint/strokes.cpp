#include "unit/bake/paint/strokes.h"

#include "bake/whole/whole_plan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::tests {

using bake::Stroke;
using bake::StrokeKind;

Stroke hardStroke(StrokeKind kind, const std::vector<glm::dvec3>& points, double radius,
                  double value)
{
    Stroke stroke;
    stroke.kind = kind;
    stroke.radius = radius;
    stroke.hardness = 1.0;
    stroke.value = value;
    for (const glm::dvec3& point : points)
        stroke.points.push_back({std::llround(point.x * 1000.0), std::llround(point.y * 1000.0),
                                 std::llround(point.z * 1000.0)});
    stroke.normals = {{0, 1000, 0}};
    return stroke;
}

bake::Strokes allKinds()
{
    const auto soft = [](StrokeKind kind, const std::vector<glm::dvec3>& points, double radius,
                         double value) {
        Stroke stroke = hardStroke(kind, points, radius, value);
        stroke.hardness = 0.3;
        stroke.strength = 0.9;
        return stroke;
    };
    bake::Strokes strokes;
    strokes.file = "all";
    strokes.list = {
        soft(StrokeKind::add, {{-8.0, 0.0, -8.0}, {8.0, 0.0, 7.0}}, 2.5, 3.0),
        soft(StrokeKind::erase, {{-6.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, {7.0, 0.0, -5.0}}, 1.5, 1.0),
        soft(StrokeKind::height, {{4.0, 0.0, 4.0}}, 3.0, 1.8),
        soft(StrokeKind::dryness, {{-5.0, 0.0, -5.0}}, 2.0, 0.7),
        soft(StrokeKind::trodden, {{-9.0, 0.0, 2.0}, {0.0, 0.0, 3.0}, {9.0, 0.0, 1.0}}, 0.8, 0.4),
        soft(StrokeKind::species, {{0.0, 0.0, -6.0}, {6.0, 0.0, -2.0}}, 2.0, 1.0),
        soft(StrokeKind::set, {{-2.0, 0.0, 8.0}}, 2.0, 0.5),
        soft(StrokeKind::smooth, {{0.0, 0.0, 0.0}, {3.0, 0.0, 3.0}}, 3.0, 1.0),
        soft(StrokeKind::clear, {{5.0, 0.0, 5.0}}, 2.0, 1.0),
    };
    return strokes;
}

bake::Strokes laidOn(const terrain::GroundMesh& ground, bake::Strokes strokes)
{
    for (Stroke& stroke : strokes.list) {
        stroke.normals.clear();
        for (auto& point : stroke.points) {
            const glm::dvec2 aim = glm::dvec2{double(point[0]), double(point[2])} / 1000.0;
            std::size_t nearest = 0;
            double best = 1e300;
            for (std::size_t v = 0; v < ground.positions.size(); ++v) {
                const glm::dvec3 place = ground.origin + glm::dvec3(ground.positions[v]);
                if (const double away = glm::distance(aim, glm::dvec2(place.x, place.z));
                    away < best) {
                    best = away;
                    nearest = v;
                }
            }
            const double height = ground.origin.y + double(ground.positions[nearest].y);
            point[1] = std::llround(height * 1000.0);
            const glm::dvec3 normal = 1000.0 * glm::dvec3(ground.normals[nearest]);
            stroke.normals.push_back({static_cast<std::int16_t>(std::lround(normal.x)),
                                      static_cast<std::int16_t>(std::lround(normal.y)),
                                      static_cast<std::int16_t>(std::lround(normal.z))});
        }
    }
    return strokes;
}

bool isInReach(const Stroke& stroke, const glm::dvec3& place, double more)
{
    const auto at = [&](std::size_t i) {
        return glm::dvec3(double(stroke.points[i][0]), double(stroke.points[i][1]),
                          double(stroke.points[i][2])) /
               1000.0;
    };
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        const glm::dvec3 from = at(i);
        const glm::dvec3 along = at(std::min(i + 1, stroke.points.size() - 1)) - from;
        const double squared = glm::dot(along, along);
        const double share =
            squared > 0.0 ? glm::clamp(glm::dot(place - from, along) / squared, 0.0, 1.0) : 0.0;
        if (glm::distance(place, from + share * along) < stroke.radius + more)
            return true;
    }
    return false;
}

bool isInReach(const bake::Strokes& strokes, const glm::dvec3& place, double more)
{
    return std::any_of(strokes.list.begin(), strokes.list.end(),
                       [&](const Stroke& stroke) { return isInReach(stroke, place, more); });
}

bake::Sampling paintedRoots(const terrain::GroundMesh& ground, const bake::BakeSettings& settings)
{
    Diagnostics diagnostics;
    Progress progress;
    const terrain::SurfaceFeatures features = bake::featuresOf(ground, settings);
    const bake::BakePlan plan =
        bake::planWhole({ground, features}, settings, diagnostics, progress);
    const bake::RootFilter filter(ground, settings, nullptr, &features, plan.plan.scale);
    return bake::sampleRoots(ground, settings, filter, plan.roots, progress);
}

bake::BakeResult paintedField(const terrain::GroundMesh& ground, const bake::BakeSettings& settings,
                              int threads)
{
    Diagnostics diagnostics;
    Progress progress;
    return bake::bakeField(ground, settings, threads, diagnostics, progress);
}

} // namespace sward::tests
