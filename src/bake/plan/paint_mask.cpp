#include "bake/plan/paint_mask.h"

#include "bake/filter/root_filter.h"
#include "bake/plan/plan.h"
#include "bake/sample/surface_sampler.h"
#include "bake/sample/triangle_points.h"
#include "bake/settings/threads.h"
#include "core/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace sward::bake {
namespace {

constexpr const char* maskCoordinates = "TEXCOORD_0";
constexpr double dilation = 2.0;      // [texels]
constexpr double sharedEdge = 1e-3;   // [texels] neighbours cover a texel both, if no deeper
constexpr double widestSpan = 1.0001; // of a triangle [images]
constexpr std::uint32_t noTriangle = 0xffffffffU;
constexpr std::uint8_t steps = 254; // of distances up to `dilation`
constexpr double white = 255.0;

// Corners of a triangle in texels; texel (i, j) has its middle at (i, j).
using Corners = std::array<glm::dvec2, 3>;

double crossOf(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// The point of a triangle nearest to a texel's middle.
struct NearestPoint {
    glm::dvec3 weights{0.0};
    double outside = 0.0; // [texels] distance from the triangle
    double inside = 0.0;  // [texels] from the triangle's edges; 0 outside
};

NearestPoint nearestPoint(const Corners& corners, const glm::dvec2& place)
{
    // Most texels are inside.
    const double area = crossOf(corners[1] - corners[0], corners[2] - corners[0]);
    glm::dvec3 weights(-1.0);
    for (std::size_t i = 0; area != 0.0 && i < 3; ++i)
        weights[glm::length_t((i + 2) % 3)] =
            crossOf(corners[(i + 1) % 3] - corners[i], place - corners[i]) / area;
    NearestPoint best;
    if (std::min({weights.x, weights.y, weights.z}) >= 0.0) {
        best.weights = weights;
        best.inside = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 3; ++i)
            best.inside =
                std::min(best.inside, weights[glm::length_t((i + 2) % 3)] * std::fabs(area) /
                                          glm::length(corners[(i + 1) % 3] - corners[i]));
        return best;
    }
    best.outside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const glm::dvec2 edge = corners[next] - corners[i];
        const glm::dvec2 offset = place - corners[i];
        const double squared = glm::dot(edge, edge);
        const double share =
            squared > 0.0 ? std::clamp(glm::dot(edge, offset) / squared, 0.0, 1.0) : 0.0;
        const double away = glm::length(offset - share * edge);
        if (away < best.outside) {
            best.outside = away;
            best.weights = glm::dvec3(0.0);
            best.weights[glm::length_t(i)] = 1.0 - share;
            best.weights[glm::length_t(next)] = share;
        }
    }
    return best;
}

// Which triangle each texel shows.
class TexelMap {
public:
    TexelMap(const terrain::GroundMesh& ground, std::uint32_t size)
        : ground_(ground)
        , own_(ground.attributes.find(maskCoordinates))
        , size_(size)
        , triangle_(std::size_t(size) * size, noTriangle)
        , distance_(std::size_t(size) * size, UINT8_MAX)
    {
    }

    // Throws if bearing ground has no coordinates.
    void check() const
    {
        std::vector<bool> bears(ground_.materials.size(), false);
        std::vector<bool> isMapped(ground_.materials.size(), false);
        for (std::size_t t = 0; t < ground_.triangles.size(); ++t) {
            if (ground_.bears[t] == 0)
                continue;
            const std::uint32_t material = ground_.materialOf[t];
            for (const terrain::AttributeGap& gap : ground_.attributes.gaps)
                if (gap.attribute == maskCoordinates && gap.first <= t && t < gap.end)
                    failAt(material, ground_.attributes.parts[gap.part] + ": ");
            bears[material] = true;
            if (!isMapped[material])
                for (glm::length_t corner = 0; corner < 3; ++corner)
                    isMapped[material] =
                        isMapped[material] || uvOf(ground_.triangles[t][corner]) != glm::dvec2(0.0);
        }
        for (std::uint32_t m = 0; m < bears.size(); ++m)
            if (bears[m] && !isMapped[m])
                failAt(m, "");
    }

    // Adds a bearing triangle; returns how many texels it shares with triangles before it.
    std::uint64_t add(std::uint32_t t)
    {
        const Corners corners = cornersOf(t);
        const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
        const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        const glm::dvec2 span = (high - low) / double(size_);
        if (!(std::max(span.x, span.y) <= widestSpan))
            fail(ErrorKind::input,
                 "--paint-mask: texture coordinates of material \"{}\" repeat: a triangle spans "
                 "{:.3g} x {:.3g} images, at most 1 can be painted; --material and --node choose "
                 "what bears grass",
                 ground_.materials[ground_.materialOf[t]].name, span.x, span.y);
        std::uint64_t shared = 0;
        const auto first = glm::dvec2(std::ceil(low.x - dilation), std::ceil(low.y - dilation));
        for (double y = first.y; y <= high.y + dilation; ++y)
            for (double x = first.x; x <= high.x + dilation; ++x) {
                const glm::dvec2 place(x, y);
                const NearestPoint near = nearestPoint(corners, place);
                if (near.outside > dilation)
                    continue;
                const std::size_t texel = texelAt(x, y);
                const auto away =
                    static_cast<std::uint8_t>(std::ceil(near.outside / dilation * double(steps)));
                if (away == 0 && distance_[texel] == 0 && near.inside > sharedEdge)
                    shared += pointOf(texel, triangle_[texel]).inside > sharedEdge ? 1U : 0U;
                if (away < distance_[texel]) {
                    distance_[texel] = away;
                    triangle_[texel] = t;
                }
            }
        return shared;
    }

    // Number of the triangle that a texel shows; noTriangle: none.
    std::uint32_t triangleAt(std::size_t texel) const { return triangle_[texel]; }
    bool isInside(std::size_t texel) const { return distance_[texel] == 0; }

    // The point of a triangle that a texel shows.
    NearestPoint pointOf(std::size_t texel, std::uint32_t t) const
    {
        // Of the places where the image repeats, the one nearest to the triangle.
        const Corners corners = cornersOf(t);
        const double side = size_;
        const glm::dvec2 at(double(texel % size_), double(texel / size_));
        const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
        const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        const glm::dvec2 first = at + side * glm::ceil((low - dilation - at) / side);
        NearestPoint best;
        best.outside = std::numeric_limits<double>::infinity();
        for (double y = first.y; y <= high.y + dilation; y += side)
            for (double x = first.x; x <= high.x + dilation; x += side)
                if (const NearestPoint near = nearestPoint(corners, {x, y});
                    near.outside < best.outside ||
                    (near.outside == best.outside && near.inside > best.inside))
                    best = near;
        return best;
    }

private:
    glm::dvec2 uvOf(std::uint32_t vertex) const
    {
        return own_ != nullptr ? glm::dvec2(own_->values[vertex]) : glm::dvec2(ground_.uvs[vertex]);
    }

    Corners cornersOf(std::uint32_t t) const
    {
        const glm::uvec3 vertices = ground_.triangles[t];
        Corners corners;
        for (glm::length_t i = 0; i < 3; ++i)
            corners[std::size_t(i)] = uvOf(vertices[i]) * double(size_) - 0.5;
        return corners;
    }

    std::size_t texelAt(double x, double y) const
    {
        const double side = size_;
        const auto column = static_cast<std::size_t>(x - side * std::floor(x / side));
        const auto row = static_cast<std::size_t>(y - side * std::floor(y / side));
        return row * size_ + column;
    }

    [[noreturn]] void failAt(std::uint32_t material, const std::string& part) const
    {
        fail(ErrorKind::input,
             "--paint-mask: {}material \"{}\" has no texture coordinates {}; --material and "
             "--node choose what bears grass",
             part, ground_.materials[material].name, maskCoordinates);
    }

    const terrain::GroundMesh& ground_;
    const terrain::VertexAttribute* own_;
    std::uint32_t size_;
    std::vector<std::uint32_t> triangle_;
    std::vector<std::uint8_t> distance_; // in steps; 0: the texel's middle is inside
};

// What is left of the settings: masks and strokes.
BakeSettings masksAndStrokes(const BakeSettings& settings)
{
    BakeSettings painted;
    painted.sides = settings.sides;
    painted.masks = settings.masks;
    painted.strokes = settings.strokes;
    painted.meadow = settings.meadow;
    for (SpeciesTraits& species : painted.meadow.species) {
        species.habitat = {};
        species.cover = 1.0;
    }
    return painted;
}

} // namespace

void addPaintMaskInputs(terrain::MaskInputs& inputs)
{
    if (std::find(inputs.attributes.begin(), inputs.attributes.end(), maskCoordinates) ==
        inputs.attributes.end())
        inputs.attributes.emplace_back(maskCoordinates);
}

PaintMask paintMask(const terrain::GroundMesh& ground, const BakeSettings& settings,
                    std::uint32_t size, int threads, Diagnostics& diagnostics, Progress& progress)
{
    checkMasks(settings.masks, ground);
    TexelMap map(ground, size);
    map.check();
    PaintMask mask;
    mask.size = size;
    mask.values.assign(std::size_t(size) * size, 0);

    // Find the triangle of each texel, in the order of triangles.
    progress.begin("paint mask", ground.triangles.size() + size);
    for (std::uint32_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] != 0)
            mask.overlapping += map.add(t);
        progress.advance(1);
    }

    // Evaluate masks and strokes, row by row.
    const BakeSettings painted = masksAndStrokes(settings);
    const double scale =
        settings.bladeScale.value_or(automaticScale(bearingArea(ground, settings.sides)));
    const RootFilter filter(ground, painted, nullptr, nullptr, scale);
    const std::uint32_t candidate = settings.sides == Sides::back ? backSide : 0;
    std::vector<std::array<std::uint64_t, 2>> counts(size); // of each row: covered, clipped
    withThreads(threadCount(threads), [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size), [&](const auto& rows) {
            for (std::size_t row = rows.begin(); row < rows.end(); ++row) {
                std::optional<TrianglePoints> points;
                std::uint32_t last = noTriangle;
                for (std::size_t texel = row * size; texel < (row + 1) * size; ++texel) {
                    const std::uint32_t t = map.triangleAt(texel);
                    if (t == noTriangle)
                        continue;
                    if (t != last)
                        points.emplace(ground, t);
                    last = t;
                    const glm::dvec3 weights = map.pointOf(texel, t).weights;
                    const RootSample place =
                        points->at(float(weights.y), float(weights.z), candidate);
                    Reject ignored = Reject::mask;
                    const double density = filter.paintedDensity(place, -1.0, ignored);
                    mask.values[texel] = static_cast<std::uint8_t>(
                        std::lround(white * std::clamp(density, 0.0, 1.0)));
                    counts[row][0] += map.isInside(texel) ? 1U : 0U;
                    counts[row][1] += map.isInside(texel) && density > 1.0 ? 1U : 0U;
                }
                progress.advance(1);
            }
        });
    });
    for (const auto& [covered, clipped] : counts) {
        mask.covered += covered;
        mask.clipped += clipped;
    }

    const auto share = [&](std::uint64_t texels) {
        return 100.0 * double(texels) / double(std::max<std::uint64_t>(mask.covered, 1));
    };
    if (mask.clipped > 0)
        diagnostics.warn("--paint-mask: the density is above 1 on {:.3g} % of the painted texels, "
                         "and an image holds at most 1",
                         share(mask.clipped));
    if (mask.overlapping > 0)
        diagnostics.warn("--paint-mask: texture coordinates overlap: {:.3g} % of the painted "
                         "texels lie under several triangles, and show the first",
                         share(mask.overlapping));
    return mask;
}

} // namespace sward::bake
