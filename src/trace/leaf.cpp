#include "trace/leaf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::trace {
namespace {

constexpr float pi = 3.14159265358979323846f;
constexpr float alphaSquared = LeafModel::roughness * LeafModel::roughness;

float luminanceOf(glm::vec3 color)
{
    return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

// Share of unpolarised light that a smooth dielectric reflects, at this cosine to its normal.
float fresnel(float cosine)
{
    const float c = std::clamp(cosine, 0.0f, 1.0f);
    constexpr float n = LeafModel::refraction;
    const float inner = std::sqrt(1.0f - (1.0f - c * c) / (n * n));
    const float across = (c - n * inner) / (c + n * inner);
    const float along = (n * c - inner) / (n * c + inner);
    return 0.5f * (across * across + along * along);
}

// Smith's Λ of GGX for a direction with this cosine.
float lambda(float cosine)
{
    const float square = cosine * cosine;
    const float tangent = (1.0f - square) / std::max(square, 1e-12f);
    return 0.5f * (std::sqrt(1.0f + alphaSquared * std::max(tangent, 0.0f)) - 1.0f);
}

// GGX density of facet normals.
float facets(float cosine)
{
    const float d = cosine * cosine * (alphaSquared - 1.0f) + 1.0f;
    return alphaSquared / (pi * d * d);
}

// A normal among the facets seen from `out` (Heitz 2018, "Sampling the GGX Distribution of Visible
// Normals").
glm::vec3 visibleFacet(glm::vec3 out, glm::vec2 place)
{
    constexpr float a = LeafModel::roughness;
    const glm::vec3 view = glm::normalize(glm::vec3(a * out.x, a * out.y, out.z));
    const float across = view.x * view.x + view.y * view.y;
    const glm::vec3 x = across > 1e-12f
                            ? glm::vec3(-view.y, view.x, 0.0f) * (1.0f / std::sqrt(across))
                            : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 y = glm::cross(view, x);
    const float radius = std::sqrt(place.x);
    const float angle = 2.0f * pi * place.y;
    const float p = radius * std::cos(angle);
    const float half = 0.5f * (1.0f + view.z);
    const float q =
        (1.0f - half) * std::sqrt(std::max(1.0f - p * p, 0.0f)) + half * radius * std::sin(angle);
    const float rest = std::sqrt(std::max(1.0f - p * p - q * q, 0.0f));
    const glm::vec3 n = p * x + q * y + rest * view;
    return glm::normalize(glm::vec3(a * n.x, a * n.y, std::max(n.z, 1e-6f)));
}

// Density of the directions that visibleFacet() mirrors `out` to.
float mirroredDensity(glm::vec3 out, glm::vec3 half)
{
    return facets(half.z) / ((1.0f + lambda(out.z)) * 4.0f * out.z);
}

} // namespace

Leaf leafOf(glm::vec3 albedo, glm::vec3 wanted, float gloss)
{
    Leaf leaf;
    leaf.reflection = glm::clamp(albedo, 0.0f, 1.0f);
    leaf.transmission = glm::clamp(wanted, glm::vec3(0.0f), 1.0f - leaf.reflection);
    leaf.gloss = std::clamp(gloss, 0.0f, 1.0f);
    return leaf;
}

glm::vec3 cosineDirection(glm::vec2 place)
{
    const float radius = std::sqrt(place.x);
    const float angle = 2.0f * pi * place.y;
    return {radius * std::cos(angle), radius * std::sin(angle),
            std::sqrt(std::max(1.0f - place.x, 0.0f))};
}

// Probabilities of the three parts of sample(), and the factor of the diffuse ones towards `out`.
struct LeafModel::Choice {
    float coat;
    float reflection;
    float transmission;
};

LeafModel::LeafModel()
{
    // Mean of Fresnel times the shadowing of the mirrored direction, over the visible facets.
    constexpr int steps = 64;
    double sum = 0.0;
    for (std::size_t i = 0; i < entries; ++i) {
        const float cosine = (float(i) + 0.5f) / float(entries);
        const glm::vec3 out(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
        double reflected = 0.0;
        for (int x = 0; x < steps; ++x)
            for (int y = 0; y < steps; ++y) {
                const glm::vec3 facet =
                    visibleFacet(out, {(float(x) + 0.5f) / steps, (float(y) + 0.5f) / steps});
                const float facing = glm::dot(out, facet);
                const glm::vec3 in = 2.0f * facing * facet - out;
                if (in.z > 0.0f)
                    reflected += double(fresnel(facing) * (1.0f + lambda(cosine)) /
                                        (1.0f + lambda(cosine) + lambda(in.z)));
            }
        albedo_[i] = static_cast<float>(reflected / (steps * steps));
        sum += double(albedo_[i] * cosine);
    }
    meanAlbedo_ = static_cast<float>(2.0 * sum / double(entries));
}

float LeafModel::coatAlbedo(float cosine) const
{
    const float place = std::clamp(cosine * float(entries) - 0.5f, 0.0f, float(entries - 1));
    const auto i = std::min(static_cast<std::size_t>(place), entries - 2);
    return glm::mix(albedo_[i], albedo_[i + 1], place - float(i));
}

float LeafModel::coatValue(glm::vec3 out, glm::vec3 in) const
{
    const glm::vec3 half = glm::normalize(out + in);
    return fresnel(glm::dot(out, half)) * facets(half.z) /
           ((1.0f + lambda(out.z) + lambda(in.z)) * 4.0f * out.z * in.z);
}

glm::vec3 LeafModel::value(const Leaf& leaf, glm::vec3 out, glm::vec3 in) const
{
    const float coat = leaf.gloss;
    const float below = (1.0f - coat * coatAlbedo(out.z)) *
                        (1.0f - coat * coatAlbedo(std::abs(in.z))) / (1.0f - coat * meanAlbedo_);
    if (in.z <= 0.0f)
        return leaf.transmission * (below / pi);
    glm::vec3 sum = leaf.reflection * (below / pi);
    if (coat > 0.0f && out.z > 0.0f)
        sum += coat * coatValue(out, in);
    return sum;
}

LeafModel::Choice LeafModel::choiceOf(const Leaf& leaf, float cosine) const
{
    const float coat = leaf.gloss * coatAlbedo(cosine);
    const float reflection = (1.0f - coat) * luminanceOf(leaf.reflection);
    const float transmission = (1.0f - coat) * luminanceOf(leaf.transmission);
    const float all = coat + reflection + transmission;
    if (!(all > 0.0f))
        return {0.0f, 1.0f, 0.0f};
    return {coat / all, reflection / all, transmission / all};
}

float LeafModel::density(const Leaf& leaf, glm::vec3 out, glm::vec3 in) const
{
    const Choice choice = choiceOf(leaf, out.z);
    if (in.z <= 0.0f)
        return choice.transmission * -in.z / pi;
    float sum = choice.reflection * in.z / pi;
    if (choice.coat > 0.0f)
        sum += choice.coat * mirroredDensity(out, glm::normalize(out + in));
    return sum;
}

Scattered LeafModel::sample(const Leaf& leaf, glm::vec3 out, float choice, glm::vec2 place) const
{
    const Choice part = choiceOf(leaf, out.z);
    Scattered scattered;
    if (choice < part.coat) {
        const glm::vec3 facet = visibleFacet(out, place);
        scattered.direction = 2.0f * glm::dot(out, facet) * facet - out;
        // The facets would reflect it into one another.
        if (scattered.direction.z <= 0.0f)
            return scattered;
    } else {
        scattered.direction = cosineDirection(place);
        if (choice >= part.coat + part.reflection)
            scattered.direction.z = -scattered.direction.z;
    }
    const float p = density(leaf, out, scattered.direction);
    if (p > 0.0f)
        scattered.weight =
            value(leaf, out, scattered.direction) * (std::abs(scattered.direction.z) / p);
    return scattered;
}

} // namespace sward::trace
