#include "field/measure/leaf_heights.h"

#include "field/measure/resting_blade.h"
#include "field/organs.h"
#include "shaders/shared/bezier.h"
#include "shaders/shared/shape.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sward::field {
namespace {

constexpr std::size_t wantedBlades = 20'000;

/// Share of the leaf area above LeafHeights::top.
constexpr float shareAboveTop = 0.001f;

/// Pieces of a blade's area.
constexpr std::size_t pieces = 12;

/// Heights and areas of pieces of leaves, and the sum of blades' heights times areas.
struct Leaves {
    std::vector<std::pair<float, float>> pieces;
    double heights = 0.0;
    double area = 0.0;
    double projection = 0.0; ///< sum of areas seen from above
};

void addBlade(const FieldView& field, const shared::Environment& calm,
              const std::vector<shared::Organ>& organs, const shared::Blade& blade, Leaves& leaves)
{
    const shared::PosedBlade posed = restingBlade(field, viewOf(organs), calm, blade);
    const BladePart part = partOf(field.species[blade.species], blade);
    const float area =
        part.length * blade.width * shared::outlineArea(part.look->shape, part.look->tipThreshold);
    leaves.heights += double(area) * double(blade.height);
    leaves.area += double(area);
    const auto heightOf = [&](const glm::vec3& place) {
        return std::max(glm::dot(place - blade.root, blade.up), 0.0f);
    };
    std::array<float, pieces> widths{};
    float sum = 0.0f;
    const auto middleOf = [](std::size_t i) { return (static_cast<float>(i) + 0.5f) / pieces; };
    for (std::size_t i = 0; i < pieces; ++i) {
        const glm::vec2 edges =
            shared::outlineAt(part.look->shape, part.look->tipThreshold, middleOf(i));
        widths[i] = edges.y - edges.x;
        sum += widths[i];
    }
    for (std::size_t i = 0; i < pieces && sum > 0.0f; ++i) {
        const float t = middleOf(i);
        const float pieceArea = area * widths[i] / sum;
        leaves.pieces.emplace_back(heightOf(shared::bezierPoint(posed.v0, posed.v1, posed.v2, t)),
                                   pieceArea);
        const glm::vec3 normal =
            glm::cross(shared::bezierTangent(posed.v0, posed.v1, posed.v2, t), posed.axis);
        const float size = glm::length(normal);
        if (size > 0.0f)
            leaves.projection += double(pieceArea * std::abs(glm::dot(normal, blade.up)) / size);
    }
}

} // namespace

LeafHeights leafHeightsOf(const FieldView& field)
{
    LeafHeights heights;
    Leaves leaves;
    const std::vector<shared::Organ> organs = organTable(field.species);
    const shared::Environment calm = calmOf(field);
    const std::size_t stride = std::max<std::size_t>(field.blades.size() / wantedBlades, 1);
    for (const shared::Patch& cell : field.patches) {
        const std::size_t end = std::size_t(cell.firstBlade) + cell.bladeCount;
        for (std::size_t i = (cell.firstBlade + stride - 1) / stride * stride; i < end; i += stride)
            addBlade(field, calm, organs, shared::unpackBlade(field.blades[i], cell), leaves);
    }
    if (!(leaves.area > 0.0))
        return heights;
    heights.mean = static_cast<float>(leaves.heights / leaves.area);
    heights.projection = static_cast<float>(leaves.projection / leaves.area);

    // Area above each height, from the top down.
    std::sort(leaves.pieces.begin(), leaves.pieces.end(), std::greater<>());
    double sum = 0.0;
    for (const auto& [height, area] : leaves.pieces) {
        sum += double(area);
        heights.top = height;
        if (sum >= double(shareAboveTop) * leaves.area)
            break;
    }
    if (!(heights.top > 0.0f))
        return {};
    for (std::size_t step = 0; step < heights.above.size(); ++step) {
        const float height =
            heights.top * static_cast<float>(step) / static_cast<float>(heights.above.size());
        double above = 0.0;
        for (const auto& [piece, area] : leaves.pieces)
            if (piece >= height)
                above += double(area);
        heights.above[step] = static_cast<float>(above / leaves.area);
    }
    return heights;
}

LeafHeights leafHeightsOf(float meanHeight)
{
    LeafHeights heights{.mean = meanHeight, .top = meanHeight};
    for (std::size_t step = 0; step < heights.above.size(); ++step)
        heights.above[step] = std::pow(
            1.0f - static_cast<float>(step) / static_cast<float>(heights.above.size()), 1.5f);
    return heights;
}

void describeHeights(const LeafHeights& heights, shared::Cover& cover)
{
    cover.stepsPerMetre =
        heights.top > 0.0f ? static_cast<float>(shared::heightSteps) / heights.top : 0.0f;
    std::array<float, shared::heightSteps> halves{};
    halves[0] = heights.projection;
    for (std::size_t i = 1; i < halves.size(); ++i)
        halves[i] = std::sqrt(heights.above[i]);
    for (std::size_t i = 0; i < halves.size(); i += 2)
        cover.leaves[i / 2] = glm::packHalf2x16(glm::vec2(halves[i], halves[i + 1]));
}

} // namespace sward::field
