#include "trace/light.h"

#include "shaders/shared/octahedral.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::trace {
namespace {

constexpr float halfTurn = 3.14159265358979323846f;

} // namespace

Sky::Sky(const Light& light)
    : sun_(glm::normalize(light.sunDirection))
    , across_(shared::tangentOf(sun_))
    , down_(glm::cross(sun_, across_))
    , up_(glm::normalize(light.up))
    , above_(meanSky * light.skyColor)
    , below_(light.groundColor)
    , sunIrradiance_(halfTurn * light.sunColor)
    , sunRadiance_(0.0f)
    , cosine_(std::cos(light.sunRadius))
    , cap_(2.0f * std::sin(0.5f * light.sunRadius) * std::sin(0.5f * light.sunRadius))
{
    // A disk of radiance L perpendicular to a surface gives it π L sin².
    const float sine = std::sin(light.sunRadius);
    if (sine > 0.0f)
        sunRadiance_ = sunIrradiance_ / (halfTurn * sine * sine);
}

glm::vec3 Sky::radiance(glm::vec3 direction) const
{
    return glm::dot(direction, up_) >= 0.0f ? above_ : below_;
}

glm::vec3 Sky::radianceWithSun(glm::vec3 direction) const
{
    const glm::vec3 sky = radiance(direction);
    return glm::dot(direction, sun_) >= cosine_ ? sky + sunRadiance_ : sky;
}

glm::vec3 Sky::towardsSun(glm::vec2 place) const
{
    const float away = cap_ * place.x;
    const float radius = std::sqrt(away * (2.0f - away));
    const float angle = 2.0f * halfTurn * place.y;
    return (1.0f - away) * sun_ + radius * (std::cos(angle) * across_ + std::sin(angle) * down_);
}

} // namespace sward::trace
