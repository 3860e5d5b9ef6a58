#include "bake/filter/site_range.h"

#include "core/math/exact_math.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::bake {
namespace {

// Wider than any rounding of a root's normal, which is stored in single precision.
constexpr double cosineSlack = 1e-6;

// The same of positions and curvatures, relative to the largest one.
constexpr double relativeSlack = 1e-6;

// Below this, a sum of normals is nearly 0 somewhere, and its direction may be any.
constexpr double shortestNormal = 1e-3;

using PartCorners = std::array<glm::dvec3, 3>;

// Values of the part's corners, interpolated between those of its triangle.
template <typename Value>
std::array<Value, 3> atCorners(const GroundPart& part, const std::array<Value, 3>& of)
{
    const auto at = [&](double b, double c) {
        return (1.0 - b - c) * of[0] + b * of[1] + c * of[2];
    };
    return {at(part.b, part.c), at(part.b + part.size, part.c), at(part.b, part.c + part.size)};
}

double lengthOf(const glm::dvec3& v)
{
    return std::sqrt(glm::dot(v, v));
}

// Interval of the cosine between `up` and unit normals that are interpolated over the part:
// dot(s, up) / |s|, where s is linear between the sums at the corners.
Interval uprightOf(const PartCorners& sums, const glm::dvec3& face, const glm::dvec3& up)
{
    const glm::dvec3 middle = sums[0] + sums[1] + sums[2];
    const double middleLength = lengthOf(middle);
    if (!(middleLength > shortestNormal))
        return {-1.0, 1.0};
    // |s| is at least its part along any direction, and that is linear.
    double shortest = 2.0;
    double longest = 0.0;
    double low = 2.0;
    double high = -2.0;
    bool agrees = true;
    for (const glm::dvec3& sum : sums) {
        shortest = std::min(shortest, glm::dot(sum, middle) / middleLength);
        longest = std::max(longest, lengthOf(sum));
        low = std::min(low, glm::dot(sum, up));
        high = std::max(high, glm::dot(sum, up));
        agrees = agrees && glm::dot(sum, face) > 0.0;
    }
    if (!(shortest > shortestNormal))
        return {-1.0, 1.0};
    Interval range{low / (low < 0.0 ? shortest : longest),
                   high / (high > 0.0 ? shortest : longest)};
    if (!agrees) {
        // Roots whose interpolated normal points to the other side have the face's normal.
        range.low = std::min(range.low, glm::dot(face, up));
        range.high = std::max(range.high, glm::dot(face, up));
    }
    return range;
}

// Widens a range of cosines by an angle, for another up-vector that far away.
Interval widened(const Interval& cosines, double angle)
{
    const double high = exactAcos(cosines.high) - angle;
    const double low = exactAcos(cosines.low) + angle;
    return {low >= 0.5 * exactTwoPi ? -1.0 : exactSinCos(low).cos,
            high <= 0.0 ? 1.0 : exactSinCos(high).cos};
}

} // namespace

SiteRange siteRange(const terrain::GroundMesh& ground, const GroundUp& groundUp,
                    const terrain::SurfaceFeatures* features, const GroundPart& part)
{
    const glm::uvec3 t = ground.triangles[part.triangle];
    const auto of = [&](const auto& list) {
        return PartCorners{glm::dvec3(list[t.x]), glm::dvec3(list[t.y]), glm::dvec3(list[t.z])};
    };
    const PartCorners places = atCorners(part, of(ground.positions));
    const glm::dvec3 middle = (places[0] + places[1] + places[2]) / 3.0;
    const glm::dvec3 world = ground.origin + middle;
    SiteRange range;

    double reach = 0.0;   // farthest place from the middle
    double largest = 0.0; // coordinate, local or of the world
    range.altitude = {unbounded, -unbounded};
    for (const glm::dvec3& place : places) {
        reach = std::max(reach, lengthOf(place - middle));
        largest = std::max({largest, lengthOf(place), lengthOf(world)});
        const double altitude = groundUp.altitude(ground.origin + place);
        range.altitude.low = std::min(range.altitude.low, altitude);
        range.altitude.high = std::max(range.altitude.high, altitude);
    }
    const double middleAltitude = groundUp.altitude(world);
    if (groundUp.radial) // the distance from a centre is convex: lowest between the corners
        range.altitude.low = std::min(range.altitude.low, middleAltitude - reach);
    range.altitude.low -= relativeSlack * largest;
    range.altitude.high += relativeSlack * largest;

    range.upright = uprightOf(atCorners(part, of(ground.normals)), ground.faceNormal(part.triangle),
                              groundUp.at(world));
    if (groundUp.radial) {
        if (reach < middleAltitude)
            range.upright =
                widened(range.upright, 0.25 * exactTwoPi - exactAcos(reach / middleAltitude));
        else
            range.upright = {-1.0, 1.0};
    }
    range.upright.low -= cosineSlack;
    range.upright.high += cosineSlack;

    if (features != nullptr && !features->curvature.empty()) {
        const std::array<double, 3> curvatures = atCorners<double>(
            part, {double(features->curvature[t.x]), double(features->curvature[t.y]),
                   double(features->curvature[t.z])});
        const auto [low, high] = std::minmax({curvatures[0], curvatures[1], curvatures[2]});
        const double slack = relativeSlack * std::max(std::fabs(low), std::fabs(high));
        range.curvature = {low - slack, high + slack};
    }
    if (part.back) {
        range.upright = {-range.upright.high, -range.upright.low};
        range.curvature = {-range.curvature.high, -range.curvature.low};
    }
    return range;
}

} // namespace sward::bake
