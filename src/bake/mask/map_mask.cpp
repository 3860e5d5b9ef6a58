#include "bake/mask/map_mask.h"

#include "core/diagnostics.h"
#include "core/error.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sward::bake {
namespace {

constexpr std::size_t maxMapSamples = 100'000'000; // 400 MB

// Under an overview of a large map, whose tiles read the map anew.
constexpr std::size_t overviewSamples = 4'000'000;

constexpr double unlimited = std::numeric_limits<double>::infinity();

// How many samples a rectangle reaches into a map, along the axis where it reaches least.
double overlapOf(const terrain::MapGrid& map, const terrain::MapBounds& bounds)
{
    const glm::dvec2 a = map.indexOf({bounds.low.x, bounds.high.y}) + 0.5,
                     b = map.indexOf({bounds.high.x, bounds.low.y}) + 0.5;
    const glm::dvec2 overlap = glm::min(b, glm::dvec2(map.size)) - glm::max(a, glm::dvec2(0.0));
    return std::min(overlap.x, overlap.y);
}

} // namespace

MapMask::MapMask(std::string file, int band, std::vector<double> classes, std::string text)
    : file_(std::move(file))
    , band_(band)
    , classes_(std::move(classes))
    , text_(std::move(text))
{
}

void MapMask::read(const terrain::GroundMesh& ground)
{
    terrain::MapBounds bounds{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        for (glm::length_t corner = 0; ground.bears[t] != 0 && corner < 3; ++corner) {
            const glm::dvec3 place =
                ground.origin + glm::dvec3(ground.positions[ground.triangles[t][corner]]);
            bounds.low = glm::min(bounds.low, glm::dvec2(place.x, -place.z));
            bounds.high = glm::max(bounds.high, glm::dvec2(place.x, -place.z));
        }
    if (!(bounds.low.x <= bounds.high.x))
        return;
    const std::lock_guard lock(mutex_);
    // A part of the ground that has been read, such as a tile of it, needs no more.
    if (isRead_ && system_ == ground.mapSystem &&
        glm::all(glm::greaterThanEqual(bounds.low, read_.low)) &&
        glm::all(glm::lessThanEqual(bounds.high, read_.high)))
        return;
    Diagnostics diagnostics;
    terrain::MapRequest request{.band = band_,
                                .classes = classes_,
                                .system = ground.mapSystem,
                                .within = {},
                                .maxSamples = ground.overview > 1 ? overviewSamples : maxMapSamples,
                                .mayThin = ground.overview > 1};
    const std::string option = "--mask " + text_;
    // The whole ground must meet the map; a part of it need not.
    double overlap = unlimited;
    if (!ground.sourceOf.empty()) {
        grid_ = terrain::openMap(file_, request, option, diagnostics)->grid();
        overlap = overlapOf(grid_, bounds);
    }
    request.within = bounds;
    try {
        if (overlap > -1.0)
            grid_ = terrain::readMap(file_, request, option, diagnostics);
    } catch (const Error&) {
        // Within a sample of the edge of a map that is resampled, it may end before.
        if (overlap > 1.0)
            throw;
    }
    read_ = bounds;
    system_ = ground.mapSystem;
    isRead_ = true;
}

double MapMask::at(glm::dvec3 place) const
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec2 index = grid_.indexOf({place.x, -place.z});
    const bool isInside = isRead_ && !grid_.values.empty() && index.x >= -0.5 && index.y >= -0.5 &&
                          index.x <= double(grid_.size.x) - 0.5 &&
                          index.y <= double(grid_.size.y) - 0.5;
    const auto sample = [&](double column, double row) {
        const auto i =
            static_cast<std::size_t>(std::clamp(column, 0.0, double(grid_.size.x) - 1.0));
        const auto j = static_cast<std::size_t>(std::clamp(row, 0.0, double(grid_.size.y) - 1.0));
        return double(grid_.values[j * grid_.size.x + i]);
    };
    if (!isInside)
        return none;
    if (!classes_.empty())
        return sample(std::round(index.x), std::round(index.y));
    const glm::dvec2 low = glm::floor(index), share = index - low;
    return glm::mix(glm::mix(sample(low.x, low.y), sample(low.x + 1.0, low.y), share.x),
                    glm::mix(sample(low.x, low.y + 1.0), sample(low.x + 1.0, low.y + 1.0), share.x),
                    share.y);
}

} // namespace sward::bake
