#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace sward::trace {

/// How a place of a thin leaf, or of the ground, scatters light. Linear, per colour channel.
struct Leaf {
    glm::vec3 reflection{0.0f}; ///< [0, 1] diffuse albedo of either side
    glm::vec3 transmission{
        0.0f};          ///< [0, 1] diffuse share that passes; reflection + transmission ≤ 1
    float gloss = 0.0f; ///< [0, 1] share of the surface that has a glossy coat
};

/// A leaf of this albedo whose transmission is `wanted`, reduced per channel where both together
/// exceed 1.
Leaf leafOf(glm::vec3 albedo, glm::vec3 wanted, float gloss);

/// A scattered direction and its weight.
struct Scattered {
    glm::vec3 direction{0.0f}; ///< unit, in the frame of the normal
    glm::vec3 weight{0.0f};    ///< BSDF times cosine, divided by the density
};

/// The BSDF of thin leaves: Lambertian reflection and transmission below a glossy coat.
///
/// The coat is a dielectric of rough facets: GGX distribution with height-correlated Smith masking
/// (Walter et al. 2007, Heitz 2014) and Fresnel's formulas. Light that the coat reflects does not
/// reach the layer below. Both diffuse parts are multiplied by (1 − E(o)) (1 − E(i)) / (1 − Ē), E
/// the albedo of the coat towards a direction, Ē its mean (Kelemen & Szirmay-Kalos 2001): the sum
/// is reciprocal, and a leaf with reflection + transmission = 1 loses no light. Multiple
/// reflections between facets are left to the layer below.
///
/// Directions are unit, point away from the leaf, and are given in the frame of its normal (z);
/// `out`.z > 0.
class LeafModel {
public:
    /// Index of refraction and roughness of the coat: n as of Comar et al. 2014 for wheat, and the
    /// geometric mean of its roughness across (0.46) and along the veins (0.18).
    static constexpr float refraction = 1.32f;
    static constexpr float roughness = 0.29f;

    LeafModel();

    /// Value of the BSDF [1/sr], without the cosine.
    glm::vec3 value(const Leaf& leaf, glm::vec3 out, glm::vec3 in) const;

    /// A random direction of the light that leaves towards `out`. `choice` and `place`: uniform
    /// in [0, 1).
    Scattered sample(const Leaf& leaf, glm::vec3 out, float choice, glm::vec2 place) const;

    /// Density of sample() [1/sr].
    float density(const Leaf& leaf, glm::vec3 out, glm::vec3 in) const;

    /// E: share of the light from a direction with this cosine that a whole coat reflects.
    float coatAlbedo(float cosine) const;

private:
    struct Choice;
    float coatValue(glm::vec3 out, glm::vec3 in) const;
    Choice choiceOf(const Leaf& leaf, float cosine) const;

    static constexpr std::size_t entries = 64;
    std::array<float, entries> albedo_{}; ///< at cosines (i + ½)/entries
    float meanAlbedo_ = 0.0f;             ///< Ē, weighted by the cosine
};

/// Direction in the frame of a normal (z), uniform per projected solid angle of the upper
/// hemisphere.
glm::vec3 cosineDirection(glm::vec2 place);

} // namespace sward::trace
