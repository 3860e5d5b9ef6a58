#include "unit/bake/sample/place_trial.h"

#include "bake/sample/triangle_points.h"
#include "core/random.h"
#include "terrain/topology/topology.h"

#include <cmath>

namespace sward::tests {

Place::Place(const terrain::GroundMesh& ground, const bake::BakeSettings& settings, double scale)
    : query_(ground)
{
    if (const terrain::FeatureChoice choice = bake::featuresFor(settings); choice.any())
        features_ = findFeatures(ground, terrain::analyse(ground), choice);
    filter_.emplace(ground, settings, &query_, &features_, scale);
}

std::vector<bake::RootSample> evenRoots(const terrain::GroundMesh& ground, double density,
                                        std::uint64_t seed)
{
    std::vector<bake::RootSample> roots;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        const bake::TrianglePoints points(ground, t);
        const bake::TriangleSequence sequence(seed, ground.source(t), false);
        const double count =
            std::floor(density * ground.area(t) + uniform(seed, ground.source(t), 99));
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
            const glm::vec2 place = sequence.at(i);
            roots.push_back(points.at(place.x, place.y, i));
        }
    }
    return roots;
}

Trial tryRoots(const terrain::GroundMesh& ground, const bake::BakeSettings& settings,
               double density)
{
    const Place place(ground, settings);
    Trial trial;
    for (const bake::RootSample& root : evenRoots(ground, density)) {
        ++trial.tried;
        const double chance =
            uniform(settings.seed, bake::keyBits(bake::keyOf(ground, root)), 1234);
        bake::Reject reason = bake::Reject::spacing;
        if (place.filter().weigh(root, chance, reason) <= chance)
            ++trial.rejected[static_cast<std::size_t>(reason)];
        else if (const auto obstacle = place.filter().obstacle(root))
            ++trial.rejected[static_cast<std::size_t>(*obstacle)];
        else
            trial.kept.push_back(root);
    }
    return trial;
}

} // namespace sward::tests
