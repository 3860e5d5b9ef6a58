#include "terrain/query/height_rays.h"

#include "core/math/floor.h"
#include "terrain/blocks.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

constexpr std::uint32_t fineSide = 8;
constexpr std::uint32_t coarseSide = 64;

// A ray so much steeper than the ground leaves it for good.
constexpr double steeper = 1.0 + 1e-6;

// Share of a cell by which a place beside an edge counts as on it: the triangle beyond counts, too.
constexpr double edgeShare = 1e-9;

constexpr float noHeight = std::numeric_limits<float>::quiet_NaN();

} // namespace

// A ray, its line in x and z, and what it met.
struct HeightRays::Stretch {
    const Ray& ray;
    double far; // [m] along the ray
    Met best;

    bool isDone() const { return ray.endsAtFirst && best.isHit(); }

    // The part of `span` in which a coordinate is in [low, high]; empty: first > second.
    glm::dvec2 within(glm::dvec2 span, double point, double along, double low, double high) const
    {
        if (along == 0.0)
            return point >= low && point <= high ? span : glm::dvec2(1.0, 0.0);
        const double a = (low - point) / along, b = (high - point) / along;
        return {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
    }
};

std::unique_ptr<const HeightRays> HeightRays::of(const GroundMesh& mesh)
{
    if (mesh.heightCells == nullptr)
        return nullptr;
    std::unique_ptr<HeightRays> rays(new HeightRays);
    if (!rays->take(mesh))
        return nullptr;
    rays->summarise();
    return rays;
}

// False if some triangle is not where its cell says.
bool HeightRays::take(const GroundMesh& mesh)
{
    const HeightCells& cells = *mesh.heightCells;
    count_ = cells.count;
    first_ = cells.first;
    step_ = cells.step;
    cells_ = cells.triangles;
    x_.assign(count_.x + 1, noHeight);
    z_.assign(count_.y + 1, noHeight);
    y_.assign(x_.size() * z_.size(), noHeight);
    const auto set = [](float& place, float value) {
        if (std::isnan(place))
            place = value;
        return place == value;
    };
    double largest = 0.0;
    for (std::uint32_t j = 0; j < count_.y; ++j)
        for (std::uint32_t i = 0; i < count_.x; ++i) {
            const std::uint32_t cell = cellAt(i, j);
            std::uint32_t t = cell / 4;
            for (const bool isUpper : {true, false}) {
                if ((cell & (isUpper ? HeightCells::upper : HeightCells::lower)) == 0)
                    continue;
                if (t >= mesh.triangles.size())
                    return false;
                const glm::uvec3 corners = mesh.triangles[t++];
                ++triangleCount_;
                const std::array<glm::uvec2, 3> points{
                    isUpper ? glm::uvec2(i, j) : glm::uvec2(i + 1, j), glm::uvec2(i, j + 1),
                    isUpper ? glm::uvec2(i + 1, j) : glm::uvec2(i + 1, j + 1)};
                for (glm::length_t k = 0; k < 3; ++k) {
                    const glm::vec3 corner = mesh.positions[corners[k]];
                    const glm::uvec2 at = points[std::size_t(k)];
                    if (!set(x_[at.x], corner.x) || !set(z_[at.y], corner.z) ||
                        !set(y_[std::size_t(at.y) * x_.size() + at.x], corner.y))
                        return false;
                    largest = std::max({largest, std::fabs(double(corner.x)),
                                        std::fabs(double(corner.y)), std::fabs(double(corner.z))});
                }
            }
        }
    slack_ = largest * 2.4e-7 + 1e-9;
    const auto liesOnLines = [&](const std::vector<float>& lines, double first, double step) {
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (std::fabs(double(lines[i]) - (first + double(i) * step)) > slack_) // false: NaN
                return false;
        return true;
    };
    return triangleCount_ == mesh.triangles.size() && liesOnLines(x_, first_.x, step_.x) &&
           liesOnLines(z_, first_.y, step_.y);
}

HeightRays::Node HeightRays::nodeOfCells(glm::uvec2 first) const
{
    Node node{0.0f, std::numeric_limits<float>::lowest()};
    const glm::uvec2 end = glm::min(first + fineSide, count_);
    for (std::uint32_t j = first.y; j < end.y; ++j)
        for (std::uint32_t i = first.x; i < end.x; ++i) {
            const std::uint32_t cell = cellAt(i, j);
            if ((cell & 3U) != 3U)
                node.slope = std::numeric_limits<float>::infinity();
            for (const bool isUpper : {true, false}) {
                if ((cell & (isUpper ? HeightCells::upper : HeightCells::lower)) == 0)
                    continue;
                const double a = yAt(isUpper ? i : i + 1, isUpper ? j : j + 1),
                             b = yAt(isUpper ? i + 1 : i, isUpper ? j : j + 1),
                             c = yAt(isUpper ? i : i + 1, isUpper ? j + 1 : j);
                const double x = (b - a) / double(x_[i + 1] - x_[i]),
                             z = (c - a) / double(z_[j + 1] - z_[j]);
                node.slope =
                    std::max(node.slope, static_cast<float>(std::sqrt(x * x + z * z) * steeper));
                node.height = std::max({node.height, float(a), float(b), float(c)});
            }
        }
    return node;
}

void HeightRays::summarise()
{
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        Level& level = levels_[k];
        level.cells = k == 0 ? fineSide : coarseSide;
        level.count = (count_ + level.cells - 1U) / level.cells;
        level.nodes.resize(std::size_t(level.count.x) * level.count.y);
        const std::uint32_t parts = coarseSide / fineSide;
        forEachBlock(level.count.y, 1, [&](std::size_t row, std::size_t) {
            const auto z = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < level.count.x; ++x) {
                Node& node = level.nodes[row * level.count.x + x];
                if (k == 0) {
                    node = nodeOfCells({x * fineSide, z * fineSide});
                    continue;
                }
                node.height = std::numeric_limits<float>::lowest();
                const Level& finer = levels_[0];
                for (std::uint32_t j = z * parts; j < std::min((z + 1) * parts, finer.count.y); ++j)
                    for (std::uint32_t i = x * parts; i < std::min((x + 1) * parts, finer.count.x);
                         ++i) {
                        node.slope = std::max(node.slope, finer.at(i, j).slope);
                        node.height = std::max(node.height, finer.at(i, j).height);
                    }
            }
        });
    }
}

Triangle HeightRays::triangleOf(std::uint32_t i, std::uint32_t j, bool isUpper) const
{
    const auto corner = [&](std::uint32_t x, std::uint32_t z) {
        return glm::dvec3(double(x_[x]), yAt(x, z), double(z_[z]));
    };
    return isUpper ? Triangle{corner(i, j), corner(i, j + 1), corner(i + 1, j)}
                   : Triangle{corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)};
}

std::vector<std::array<glm::vec3, 3>> HeightRays::triangles() const
{
    std::vector<std::array<glm::vec3, 3>> list(triangleCount_);
    for (std::uint32_t j = 0; j < count_.y; ++j)
        for (std::uint32_t i = 0; i < count_.x; ++i) {
            std::uint32_t t = cellAt(i, j) / 4;
            for (const bool isUpper : {true, false}) {
                if ((cellAt(i, j) & (isUpper ? HeightCells::upper : HeightCells::lower)) == 0)
                    continue;
                const Triangle own = triangleOf(i, j, isUpper);
                list[t++] = {glm::vec3(own.a), glm::vec3(own.b), glm::vec3(own.c)};
            }
        }
    return list;
}

// Height of the surface; NaN where there is none.
double HeightRays::surfaceAt(glm::dvec2 place) const
{
    const glm::dvec2 at = (place - first_) / step_;
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < double(count_.x) && at.y < double(count_.y)))
        return std::numeric_limits<double>::quiet_NaN();
    const auto i = static_cast<std::uint32_t>(at.x), j = static_cast<std::uint32_t>(at.y);
    const double u = at.x - double(i), v = at.y - double(j);
    if (u + v <= 1.0)
        return yAt(i, j) + u * (yAt(i + 1, j) - yAt(i, j)) + v * (yAt(i, j + 1) - yAt(i, j));
    return yAt(i + 1, j + 1) + (1.0 - u) * (yAt(i, j + 1) - yAt(i + 1, j + 1)) +
           (1.0 - v) * (yAt(i + 1, j) - yAt(i + 1, j + 1));
}

// Whether a ray begins on or above the surface and rises more than that anywhere under it. What it
// can meet is then so near that rounding of its start decides: `far` ends there.
bool HeightRays::leaves(Stretch& stretch) const
{
    const Ray& ray = stretch.ray;
    const glm::dvec2 along(ray.direction.x, ray.direction.z);
    const double level = std::sqrt(glm::dot(along, along));
    if (!(ray.direction.y > 0.0) || !(level > 0.0))
        return false;
    const glm::dvec2 from(ray.point.x, ray.point.z), to = from + along * stretch.far;
    const glm::dvec2 margin = glm::dvec2(slack_) + 0.01 * step_;
    const Level& nodes = level * stretch.far > double(2 * fineSide) * std::min(step_.x, step_.y)
                             ? levels_[1]
                             : levels_[0];
    const glm::dvec2 side = double(nodes.cells) * step_;
    const glm::dvec2 low = glm::floor((glm::min(from, to) - margin - first_) / side),
                     high = glm::floor((glm::max(from, to) + margin - first_) / side);
    float slope = 0.0f;
    for (double z = std::max(low.y, 0.0); z <= std::min(high.y, double(nodes.count.y) - 1.0); ++z)
        for (double x = std::max(low.x, 0.0); x <= std::min(high.x, double(nodes.count.x) - 1.0);
             ++x)
            slope = std::max(slope, nodes.at(std::uint32_t(x), std::uint32_t(z)).slope);
    const double gain = ray.direction.y - double(slope) * level; // of height a metre
    if (!(gain > 0.01))
        return false;
    const double depth = surfaceAt(from) - ray.point.y;
    const double error = slack_ * (2.0 + double(slope));
    if (!(depth < error))
        return false;
    stretch.far = std::min(stretch.far, 2.0 * error / gain);
    return true;
}

void HeightRays::meetTriangle(Stretch& stretch, std::uint32_t i, std::uint32_t j, bool isUpper,
                              std::uint32_t index) const
{
    const Ray& ray = stretch.ray;
    if (index == ray.ignored || (!ray.marked.empty() && ray.marked[index] != 0))
        return;
    const double distance = planeDistance(triangleOf(i, j, isUpper), ray.point, ray.direction);
    if (!(distance > ray.above && distance <= ray.limit))
        return;
    const double u = (ray.point.x + distance * ray.direction.x - double(x_[i])) /
                     (double(x_[i + 1]) - double(x_[i])),
                 v = (ray.point.z + distance * ray.direction.z - double(z_[j])) /
                     (double(z_[j + 1]) - double(z_[j]));
    const bool isInside =
        isUpper ? u >= -edgeShare && v >= -edgeShare && u + v <= 1.0 + edgeShare
                : u <= 1.0 + edgeShare && v <= 1.0 + edgeShare && u + v >= 1.0 - edgeShare;
    if (!isInside)
        return;
    Met& best = stretch.best;
    if (!best.isHit() || distance < best.distance ||
        (distance == best.distance && index < best.triangle))
        best = {index, distance};
}

void HeightRays::meetCell(Stretch& stretch, std::uint32_t i, std::uint32_t j) const
{
    const std::uint32_t cell = cellAt(i, j);
    std::uint32_t index = cell / 4;
    if ((cell & HeightCells::upper) != 0)
        meetTriangle(stretch, i, j, true, index++);
    if ((cell & HeightCells::lower) != 0)
        meetTriangle(stretch, i, j, false, index);
}

// Visits the squares of a level (2: of 64 cells, 1: of 8, 0: cells) that the ray crosses within
// `span` [m], row by row.
void HeightRays::walk(Stretch& stretch, std::size_t level, glm::dvec2 span) const
{
    const Ray& ray = stretch.ray;
    const double cells = level == 0 ? 1.0 : double(levels_[level - 1].cells);
    const glm::uvec2 count = level == 0 ? count_ : levels_[level - 1].count;
    const glm::dvec2 side = cells * step_;
    const auto range = [&](double a, double b, double first, double width, std::uint32_t number) {
        const double low = (std::min(a, b) - slack_ - first) / width,
                     high = (std::max(a, b) + slack_ - first) / width;
        return glm::dvec2(std::max(std::floor(low), 0.0),
                          std::min(std::floor(high), double(number) - 1.0));
    };
    const auto at = [&](double point, double along, double distance) {
        return point + along * distance;
    };
    const glm::dvec2 rows =
        range(at(ray.point.z, ray.direction.z, span.x), at(ray.point.z, ray.direction.z, span.y),
              first_.y, side.y, count.y);
    for (double j = rows.x; j <= rows.y; ++j) {
        const double north = first_.y + j * side.y;
        const glm::dvec2 inRow = stretch.within(span, ray.point.z, ray.direction.z, north - slack_,
                                                north + side.y + slack_);
        if (inRow.x > inRow.y)
            continue;
        const glm::dvec2 columns =
            range(at(ray.point.x, ray.direction.x, inRow.x),
                  at(ray.point.x, ray.direction.x, inRow.y), first_.x, side.x, count.x);
        for (double i = columns.x; i <= columns.y; ++i) {
            const auto x = static_cast<std::uint32_t>(i), z = static_cast<std::uint32_t>(j);
            if (level == 0) {
                meetCell(stretch, x, z);
            } else {
                const double west = first_.x + i * side.x;
                const glm::dvec2 inside = stretch.within(inRow, ray.point.x, ray.direction.x,
                                                         west - slack_, west + side.x + slack_);
                const double lowest =
                    ray.point.y + ray.direction.y * (ray.direction.y > 0.0 ? inside.x : inside.y);
                if (inside.x > inside.y ||
                    lowest > double(levels_[level - 1].at(x, z).height) + slack_)
                    continue;
                walk(stretch, level - 1, inside);
            }
            if (stretch.isDone())
                return;
        }
    }
}

HeightRays::Met HeightRays::meet(const Ray& ray) const
{
    Stretch stretch{ray, ray.limit, {}};
    if (leaves(stretch) && stretch.far <= ray.above)
        return {};
    const double reach = stretch.far * (1.0 + 1e-9);
    const double cells = reach / std::min(step_.x, step_.y);
    const std::size_t level = cells <= 4.0 ? 0 : cells <= 4.0 * fineSide ? 1 : 2;
    walk(stretch, level, {std::max(ray.above * (1.0 - 1e-9), 0.0), reach});
    return stretch.best;
}

} // namespace sward::terrain
