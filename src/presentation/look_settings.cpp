#include "presentation/look_settings.h"

#include "core/error.h"
#include "core/json/settings_json.h"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sward::presentation {

using render::FrameSettings;

namespace {

constexpr double brightest = 1000.0;       ///< radiance; that of the sky is about 1
constexpr double minShadowDistance = 0.01; ///< [m]
constexpr double maxShadowDistance = 1000.0;
constexpr double densest = 1000.0; ///< [1/m] visibility below a millimetre

/// Extinction per air mass (exponent) of clear air with a little haze.
constexpr glm::dvec3 extinction(0.08, 0.14, 0.26);

/// Sine of the sun's height by which the round earth keeps the sky of a sun on the horizon bright.
constexpr double afterglow = 0.0375;

/// The sun's height below the horizon in which the sky's light falls e times [degrees], and the
/// least share of it: more than in nature, as eyes adapt.
constexpr double twilightFold = 6.0;
constexpr double darkest = 0.04;

/// Sunlight that a leaf in a sward gets of that on a surface facing the sun: leaves stand in all
/// directions, so a low sun lights them as a high one does.
constexpr double leafProjection = 0.5;

/// Largest factor of the exposure for a low sun.
constexpr float maxAdaptation = 2.0f;

double airMass(double elevation)
{
    // The formula is defined for elevations ≥ 0.
    const double above = std::max(elevation, 0.0);
    return 1.0 / (std::sin(glm::radians(above)) + 0.50572 * std::pow(above + 6.07995, -1.6364));
}

double elevationOf(glm::vec3 direction)
{
    return glm::degrees(std::asin(glm::normalize(glm::dvec3(direction)).y));
}

double usualElevation()
{
    return elevationOf(FrameSettings().sunDirection);
}

/// Light that clear air scatters out of the sun's beam, for each area of level ground: half of it
/// comes down as the light of the sky (Bird & Hulstrom 1981).
glm::dvec3 scattered(double elevation)
{
    const double rise = std::max(std::sin(glm::radians(elevation)), 0.0);
    return std::sqrt(rise * rise + afterglow * afterglow) *
           (1.0 - glm::exp(-extinction * airMass(elevation)));
}

/// Share of the sky's light that is left with the sun at `elevation` [degrees].
glm::dvec3 skyShareAt(double elevation)
{
    const double usual = usualElevation();
    if (elevation >= usual)
        return glm::dvec3(1.0);
    const glm::dvec3 share = scattered(elevation) / scattered(usual);
    return elevation >= 0.0 ? share : glm::max(share * std::exp(elevation / twilightFold), darkest);
}

double azimuthOf(glm::vec3 direction)
{
    const glm::dvec3 d(direction);
    return glm::degrees(std::atan2(d.x, -d.z));
}

} // namespace

glm::vec3 sunTowards(double azimuth, double elevation)
{
    const double a = glm::radians(azimuth);
    const double e = glm::radians(elevation);
    return glm::vec3(
        glm::dvec3(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)));
}

SunPlace sunPlaceOf(glm::vec3 direction)
{
    return {azimuthOf(direction), elevationOf(direction)};
}

glm::vec3 sunColorAt(double elevation)
{
    const FrameSettings usual;
    const double more = airMass(elevation) - airMass(usualElevation());
    return glm::vec3(glm::dvec3(usual.sunColor) * glm::exp(-extinction * more));
}

glm::vec3 skyColorAt(double elevation)
{
    return glm::vec3(glm::dvec3(FrameSettings().skyColor) * skyShareAt(elevation));
}

glm::vec3 groundColorAt(double elevation)
{
    const FrameSettings usual;
    const double lowered = std::min(elevation, usualElevation());
    const glm::dvec3 sky = 0.5 * 1.25 * glm::dvec3(usual.skyColor);
    const glm::dvec3 sun = leafProjection * glm::dvec3(usual.sunColor);
    const glm::dvec3 low =
        elevation > 0.0 ? leafProjection * glm::dvec3(sunColorAt(lowered)) : glm::dvec3(0.0);
    return glm::vec3(glm::dvec3(usual.groundColor) * (low + sky * skyShareAt(lowered)) /
                     (sun + sky));
}

float adaptationAt(double elevation)
{
    // The light of grass is that on its leaves.
    const auto brightness = [](glm::vec3 light) {
        return glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    };
    const float left =
        brightness(groundColorAt(elevation)) / brightness(FrameSettings().groundColor);
    return std::min(1.0f / std::sqrt(left), maxAdaptation);
}

void setLightByElevation(FrameSettings& settings)
{
    const double elevation = elevationOf(settings.sunDirection);
    settings.sunColor = elevation > 0.0 ? sunColorAt(elevation) : glm::vec3(0.0f);
    settings.skyColor = skyColorAt(elevation);
    settings.groundColor = groundColorAt(elevation);
    settings.adaptation = adaptationAt(elevation);
}

void readLook(SettingsReader& reader, FrameSettings& settings)
{
    if (!reader.has("look"))
        return;
    SettingsReader look(reader.child("look"), reader.placeOf("look"));
    if (look.has("sun")) {
        SettingsReader sun(look.child("sun"), look.placeOf("sun"));
        if (sun.has("azimuth") || sun.has("elevation")) {
            double azimuth = azimuthOf(settings.sunDirection);
            double elevation = elevationOf(settings.sunDirection);
            sun.read("azimuth", azimuth, -360.0, 360.0);
            sun.read("elevation", elevation, -90.0, 90.0);
            settings.sunDirection = sunTowards(azimuth, elevation);
            settings.sunColor = sunColorAt(elevation);
            if (sun.has("elevation")) {
                settings.skyColor = skyColorAt(elevation);
                settings.groundColor = groundColorAt(elevation);
                settings.adaptation = adaptationAt(elevation);
            }
        }
        sun.readColor("color", settings.sunColor, 0.0, brightest);
        sun.finish();
    }
    look.readColor("sky", settings.skyColor, 0.0, brightest);
    look.readColor("ground", settings.groundColor, 0.0, brightest);
    look.read("fog", settings.fogDensity, 0.0, densest);
    look.read("fog_height", settings.fogHeight, 0.0, 1e6);
    look.read("clouds", settings.clouds, 0.0, 1.0);
    look.read("thatch", settings.thatch, 0.0, 1.0);
    look.read("blade_shadows", settings.bladeShadows);
    look.read("blade_shadow_distance", settings.bladeShadowDistance, minShadowDistance,
              maxShadowDistance);
    if (look.has("up")) {
        glm::vec3 skyUp(0.0f);
        look.read("up", skyUp, -1e6, 1e6);
        if (!(glm::length(skyUp) > 1e-6f))
            fail(ErrorKind::input, "{}: has no length", look.placeOf("up"));
        settings.skyUp = skyUp;
    }
    if (look.has("exposure")) {
        float exposure = 1.0f;
        look.read("exposure", exposure, 1e-6, 1e6);
        settings.exposure = exposure;
    }
    look.finish();
}

} // namespace sward::presentation
