#include "render/host/host_light.h"

#include "core/error.h"
#include "render/host/host_view.h"
#include "render/host/lit_field.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::render {
namespace {

static_assert(maxCascades == shared::maxCascades && maxLamps == shared::maxLamps);

/// Lamps do not get brighter below this distance [m].
constexpr double nearestLamp = 0.01;

/// The constant function of the basis.
const float constantHarmonic = 0.5f / std::sqrt(std::numbers::pi_v<float>);

bool isFinite(const glm::dmat4& matrix)
{
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

bool isFinite(glm::dvec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void requireValidLamp(const HostLamp& lamp, std::size_t index)
{
    if (!isFinite(lamp.position))
        fail(ErrorKind::usage, "lamp {}: its position is not finite", index);
    if (!(lamp.range > 0.0f && std::isfinite(lamp.range)))
        fail(ErrorKind::usage, "lamp {}: its range is {} m, not above 0", index, lamp.range);
    if (!isFinite(glm::dvec3(lamp.color)) ||
        std::min({lamp.color.x, lamp.color.y, lamp.color.z}) < 0.0f)
        fail(ErrorKind::usage, "lamp {}: its colour is negative or not finite", index);
    if (!lamp.cone)
        return;
    const float length = glm::length(lamp.cone->direction);
    if (!(length > 0.0f && std::isfinite(length)))
        fail(ErrorKind::usage, "lamp {}: its direction has no length", index);
    const float inner = lamp.cone->innerCosine;
    const float outer = lamp.cone->outerCosine;
    if (!(outer >= -1.0f && inner > outer && inner <= 1.0f))
        fail(ErrorKind::usage, "lamp {}: its cosines are {} inside and {} outside", index, inner,
             outer);
}

/// One channel of the irradiance over π as a quadratic form of (normal, 1): the coefficients times
/// 1, 2/3 and 1/4 times their functions.
glm::dmat4 quadraticFormOf(const std::array<glm::vec3, 9>& radiance, glm::length_t channel)
{
    const auto l = [&](std::size_t i) { return double(radiance[i][channel]); };
    const double pi = std::numbers::pi;
    const double first = 0.5 / std::sqrt(pi);
    const double second = std::sqrt(3.0 / (4.0 * pi)) * 2.0 / 3.0;
    const double mixed = std::sqrt(15.0 / (4.0 * pi)) / 4.0;
    const double height = std::sqrt(5.0 / (16.0 * pi)) / 4.0;
    // Each product of two coordinates stands at two places.
    glm::dmat4 form(0.0);
    form[0][0] = 0.5 * mixed * l(8);
    form[1][1] = -0.5 * mixed * l(8);
    form[2][2] = 3.0 * height * l(6);
    form[3][3] = first * l(0) - height * l(6);
    form[0][1] = form[1][0] = 0.5 * mixed * l(4);
    form[1][2] = form[2][1] = 0.5 * mixed * l(5);
    form[0][2] = form[2][0] = 0.5 * mixed * l(7);
    form[1][3] = form[3][1] = 0.5 * second * l(1);
    form[2][3] = form[3][2] = 0.5 * second * l(2);
    form[0][3] = form[3][0] = 0.5 * second * l(3);
    return form;
}

glm::dvec4 rowOfMatrix(const glm::dmat4& matrix, glm::length_t row)
{
    return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

shared::Cascade cascadeOf(const HostShadow& shadow, const glm::dmat4& worldToShadow,
                          const glm::dmat4& toWorld)
{
    const glm::dmat4 toShadow = worldToShadow * toWorld;
    const glm::dvec4 w = rowOfMatrix(toShadow, 3);
    const glm::dvec4 x = rowOfMatrix(toShadow, 0) / w.w;
    const glm::dvec4 y = rowOfMatrix(toShadow, 1) / w.w;
    glm::dvec4 z = rowOfMatrix(toShadow, 2) / w.w;
    const double perMetre = glm::length(glm::dvec3(rowOfMatrix(worldToShadow, 2))) / w.w;
    z.w += (shadow.hasReversedZ ? 1.0 : -1.0) * double(shadow.bias) * perMetre;
    const glm::dvec4 middle(0.0, 0.0, 0.0, 0.5);
    const double widest = 2.0 / std::min(glm::length(glm::dvec3(x)), glm::length(glm::dvec3(y)));
    return {glm::vec4(0.5 * x + middle), glm::vec4(0.5 * y + middle), glm::vec4(z),
            static_cast<float>(widest)};
}

shared::Lamp lampOf(const HostLamp& lamp, const Placement& placement, glm::vec3 position)
{
    const double scale = placement.scale;
    shared::Lamp result = {};
    result.position = position;
    result.perRange = static_cast<float>(scale / double(lamp.range));
    // The inverse square of a distance in the field's metres.
    result.color = glm::vec3(glm::dvec3(lamp.color) / (scale * scale));
    result.nearest = static_cast<float>(nearestLamp / scale);
    result.coneEdge = 1.0f;
    if (lamp.cone) {
        result.direction = placement.directionInField(glm::normalize(lamp.cone->direction));
        result.perCone = 1.0f / (lamp.cone->innerCosine - lamp.cone->outerCosine);
        result.coneEdge = -lamp.cone->outerCosine * result.perCone;
    }
    return result;
}

} // namespace

HostAmbient HostAmbient::constant(glm::vec3 radiance)
{
    HostAmbient ambient;
    ambient.radiance[0] = radiance / constantHarmonic;
    return ambient;
}

void requireValid(const HostLight& light)
{
    if (light.ambient)
        for (const glm::vec3& coefficient : light.ambient->radiance)
            if (!isFinite(glm::dvec3(coefficient)))
                fail(ErrorKind::usage, "ambient light: a coefficient is not finite");
    for (std::size_t i = 0; i < light.lamps.size(); ++i)
        requireValidLamp(light.lamps[i], i);
}

void requireValid(const HostShadow& shadow)
{
    if (shadow.view == VK_NULL_HANDLE)
        fail(ErrorKind::usage, "shadow map: its view is null");
    if (shadow.worldToShadow.empty() || shadow.worldToShadow.size() > shared::maxCascades)
        fail(ErrorKind::usage, "shadow map: {} cascades, not 1 to {}", shadow.worldToShadow.size(),
             shared::maxCascades);
    for (std::size_t i = 0; i < shadow.worldToShadow.size(); ++i) {
        const glm::dmat4& matrix = shadow.worldToShadow[i];
        if (!isFinite(matrix) || glm::determinant(matrix) == 0.0)
            fail(ErrorKind::usage, "shadow map: the matrix of cascade {} has no inverse", i);
        if (!isParallel(matrix))
            fail(ErrorKind::usage, "shadow map: the rays of cascade {} are not parallel", i);
    }
    requireSampledDepth(shadow.image, true, "shadow map");
    if (!std::isfinite(shadow.bias) || !std::isfinite(shadow.lift))
        fail(ErrorKind::usage, "shadow map: bias or lift is not finite");
}

shared::HostLight hostLightOf(const HostLight& light, const std::optional<HostShadow>& shadow,
                              const LitField& field)
{
    const Placement& placement = field.placement;
    const Aabb& content = field.content;
    const glm::dmat4 toWorld = placement.toWorld(field.origin);
    shared::HostLight result = {};
    if (light.ambient) {
        // A direction in the field, turned into the world's.
        const glm::dmat4 turn(glm::mat3_cast(placement.rotation));
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            glm::mat4& form = result.ambient[channel];
            form = glm::mat4(glm::transpose(turn) *
                             quadraticFormOf(light.ambient->radiance, channel) * turn);
            result.above[channel] = shared::ambientLight(form, field.skyUp);
        }
        result.hasAmbient = 1;
    }
    for (const HostLamp& lamp : light.lamps) {
        const glm::vec3 position(placement.placeInField(lamp.position) - field.origin);
        const double reach = double(lamp.range) / placement.scale;
        const glm::vec3 nearest = glm::clamp(position, content.low, content.high);
        if (!content.isEmpty() && double(glm::distance(position, nearest)) < reach)
            result.lamps[result.lampCount++] = lampOf(lamp, placement, position);
    }
    if (shadow) {
        for (const glm::dmat4& worldToShadow : shadow->worldToShadow)
            result.cascades[result.cascadeCount++] = cascadeOf(*shadow, worldToShadow, toWorld);
        result.nearer = shadow->hasReversedZ ? -1.0f : 1.0f;
        result.lift = shadow->lift;
    }
    return result;
}

} // namespace sward::render
