#include "bake/whole/all_cells.h"

#include "core/stopwatch.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sward::bake {
namespace {

// Blades that grow at most, strokes included.
double expectedWithStrokes(const BakeSettings& settings, const Plan& plan)
{
    const double density = plan.area > 0.0 ? plan.expected / plan.area : 0.0;
    double more = 0.0;
    double highest = 1.0;
    for (const Stroke& stroke : settings.strokes.list) {
        if (settings.spread != Spread::uniform || stroke.value <= 1.0 ||
            (stroke.kind != StrokeKind::add && stroke.kind != StrokeKind::set))
            continue;
        double area = 3.15 * stroke.radius * stroke.radius;
        for (std::size_t i = 1; i < stroke.points.size(); ++i) {
            double squared = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double step = double(stroke.points[i][axis] - stroke.points[i - 1][axis]);
                squared += step * step;
            }
            area += 2.0 * stroke.radius * std::sqrt(squared) / 1000.0;
        }
        more += area * (stroke.value - 1.0) * density;
        highest = std::max(highest, stroke.value);
    }
    return plan.expected + std::min(more, (highest - 1.0) * plan.expected);
}

} // namespace

bool hasManyTriangles(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const TileLimits& limits)
{
    return ground.triangles.size() > limits.trianglesInOne && needsRays(ground, settings);
}

bool needsTiles(const terrain::GroundMesh& ground, const BakeSettings& settings,
                const BakePlan& plan, const TileLimits& limits)
{
    return expectedWithStrokes(settings, plan.plan) > limits.inOne ||
           hasManyTriangles(ground, settings, limits);
}

void bakeAllCells(const GroundView& whole, const BakeSettings& settings, const BakePlan& plan,
                  const TileLimits& limits, const TakeTile& take, Progress& progress)
{
    const terrain::GroundMesh& ground = whole.ground;
    if (!needsTiles(ground, settings, plan, limits)) {
        take(bakeTile(whole, settings, plan, nullptr, progress));
        return;
    }
    // A tile also samples its surroundings: its actual number of blades is slightly larger.
    const double margin = tileMargin(ground, settings, plan);
    double wanted = std::ceil(expectedWithStrokes(settings, plan.plan) / limits.inTile);
    if (hasManyTriangles(ground, settings, limits))
        wanted = std::max(
            wanted, std::ceil(double(ground.triangles.size()) / double(limits.trianglesInTile)));
    const auto count = static_cast<std::size_t>(wanted);
    forEachTile(whole, count, margin, [&](const GroundView& part, const TileRegion& tile) {
        take(bakeTile(part, settings, plan, &tile, progress));
    });
}

void forEachTile(const GroundView& whole, std::size_t count, double margin,
                 const std::function<void(const GroundView& part, const TileRegion& tile)>& bake)
{
    const terrain::GroundMesh& ground = whole.ground;
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, count);
    std::vector<std::vector<std::uint32_t>> near = trianglesNear(ground, tiles, margin);
    for (std::vector<std::uint32_t>& triangles : near)
        triangles.shrink_to_fit();
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (tiles[i].empty())
            continue;
        const terrain::GroundMesh part = partOf(ground, near[i]);
        const terrain::SurfaceFeatures features = partOf(ground, whole.features, near[i], margin);
        std::vector<std::uint32_t>().swap(near[i]);
        bake({part, features}, TileRegion(ground.origin, tiles[i]));
    }
}

PreparedGround prepareGround(const terrain::GroundMesh& ground, const BakeSettings& settings,
                             const TileLimits& limits, Report::Timing& timing)
{
    PreparedGround prepared;
    tbb::parallel_invoke(
        [&] {
            Stopwatch own;
            prepared.features = featuresOf(ground, settings);
            timing.topology = own.lap();
        },
        [&] {
            Stopwatch own;
            if (needsRays(ground, settings) && !hasManyTriangles(ground, settings, limits))
                prepared.rays.emplace(ground);
            timing.rays = own.lap();
        });
    return prepared;
}

} // namespace sward::bake
