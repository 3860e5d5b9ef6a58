#include "bake/root_filter.h"

#include "core/exact_math.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::bake {
namespace {

constexpr double degreesPerRadian = 57.29577951308232;

constexpr double wholeCircle = 180.0;
constexpr double anyAltitude = 1e300;

} // namespace

RootFilter::RootFilter(const terrain::GroundMesh& ground, const BakeSettings& settings,
                       const terrain::SurfaceQuery* query)
    : ground_(ground)
    , settings_(settings)
    , query_(query)
    , weighsSlope_(settings.slope.low > 0.0 || settings.slope.high < wholeCircle)
    , weighsAltitude_(settings.altitude.low > -anyAltitude || settings.altitude.high < anyAltitude)
    , asksRays_(settings.clearance > 0.0)
{
    weighs_ = !settings.masks.empty() || weighsSlope_ || weighsAltitude_;
}

double RootFilter::maskWeight(const RootSample& root) const
{
    const glm::uvec3 corners = ground_.triangles[root.triangle];
    const float b = root.barycentric.x;
    const float c = root.barycentric.y;
    const glm::vec4 color = (1.0f - b - c) * ground_.colors[corners.x] +
                            b * ground_.colors[corners.y] + c * ground_.colors[corners.z];
    double weight = 1.0;
    for (const VertexColorMask& mask : settings_.masks) {
        const double value = double(color[static_cast<std::size_t>(mask.channel)]);
        weight *= mask.invert ? 1.0 - value : value;
    }
    return weight;
}

double RootFilter::weigh(const RootSample& root, double chance, Reject& reason) const
{
    if (!weighs_)
        return 1.0;
    double weight = 1.0;
    const auto falls = [&](Reject factorsReason, double factor) {
        weight *= factor;
        if (weight > chance)
            return false;
        reason = factorsReason;
        return true;
    };

    if (!settings_.masks.empty() && falls(Reject::mask, maskWeight(root)))
        return weight;
    if (!weighsSlope_ && !weighsAltitude_)
        return weight;

    const glm::dvec3 place = ground_.origin + glm::dvec3(root.position);
    const glm::dvec3 groundUp = settings_.groundUp.at(place);
    if (weighsSlope_) {
        const double slope =
            exactAcos(glm::dot(glm::dvec3(root.normal), groundUp)) * degreesPerRadian;
        if (falls(Reject::slope, settings_.slope.weight(slope)))
            return weight;
    }
    if (weighsAltitude_) {
        const double altitude = settings_.groundUp.radial
                                    ? std::sqrt(glm::dot(place - settings_.groundUp.centre,
                                                         place - settings_.groundUp.centre))
                                    : glm::dot(place, groundUp);
        falls(Reject::altitude, settings_.altitude.weight(altitude));
    }
    return weight;
}

std::optional<Reject> RootFilter::obstacle(const RootSample& root) const
{
    if (settings_.clearance > 0.0) {
        const double clear = query_->clearance(glm::dvec3(root.position), glm::dvec3(root.normal),
                                               settings_.clearance, root.triangle);
        if (clear < settings_.clearance)
            return Reject::clearance;
    }
    return std::nullopt;
}

} // namespace sward::bake
