#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::trace {

/// Sun and sky. The defaults are those of a frame (render::FrameSettings).
struct Light {
    /// Towards the sun; not zero.
    glm::vec3 sunDirection{0.72f, 0.62f, -0.42f};
    /// Radiance of a white Lambertian surface that faces the sun, linear: the sun's irradiance is π
    /// times this. So the renderer's look has it.
    glm::vec3 sunColor{3.4f, 2.85f, 2.1f};
    /// [rad] angular radius of the sun's disk, [0, 0.5].
    float sunRadius = 0.0046251f;
    /// Radiance of the sky's upper half at its zenith in the renderer's look, linear.
    glm::vec3 skyColor{0.42f, 0.60f, 0.92f};
    /// Radiance from below the horizon, linear.
    glm::vec3 groundColor{0.20f, 0.23f, 0.11f};
    /// Unit; direction to the zenith.
    glm::vec3 up{0.0f, 1.0f, 0.0f};
};

/// The mean sky is a quarter brighter than the zenith: see hemisphere() of the renderer.
inline constexpr float meanSky = 1.25f;

/// The light as rays meet it: a sky of two uniform halves, and a uniform disk.
class Sky {
public:
    /// Normalises the directions.
    explicit Sky(const Light& light);

    /// Radiance from unit `direction`, without the sun.
    glm::vec3 radiance(glm::vec3 direction) const;

    /// The same with the disk of the sun.
    glm::vec3 radianceWithSun(glm::vec3 direction) const;

    /// Irradiance of a surface that faces the sun.
    glm::vec3 sunIrradiance() const { return sunIrradiance_; }

    /// A direction to a place of the sun's disk, uniform for uniform `place` in [0, 1)².
    glm::vec3 towardsSun(glm::vec2 place) const;

private:
    glm::vec3 sun_;
    glm::vec3 across_; ///< unit, perpendicular to sun_ …
    glm::vec3 down_;   ///< … and to this
    glm::vec3 up_;
    glm::vec3 above_;
    glm::vec3 below_;
    glm::vec3 sunIrradiance_;
    glm::vec3 sunRadiance_;
    float cosine_; ///< of the disk's radius
    float cap_;    ///< 1 − cosine_, without loss
};

} // namespace sward::trace
