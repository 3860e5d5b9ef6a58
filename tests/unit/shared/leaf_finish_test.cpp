// Fine colours of a blade keep its mean colour, and its coat mirrors no more light than there is.
#include "shaders/shared/look/leaf_finish.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

constexpr double finishPi = 3.14159265358979323846;

// Mean of toneAlong() over the area of an outline.
glm::dvec3 meanTone(uint finish, uint shape, float threshold, uint seed)
{
    constexpr int points = 4000;
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (int i = 0; i < points; ++i) {
        const float t = (float(i) + 0.5f) / float(points);
        const vec2 edges = outlineAt(shape, threshold, t);
        const double width = double(edges.y - edges.x);
        sum += width * glm::dvec3(toneAlong(finish, t, seed));
        area += width;
    }
    return sum / area;
}

double farthestFromOne(glm::dvec3 mean)
{
    return std::max({std::abs(mean.x - 1.0), std::abs(mean.y - 1.0), std::abs(mean.z - 1.0)});
}

TEST(LeafFinish, ToneAlongABladeKeepsItsMeanColour)
{
    for (const uint seed : {0u, 90u, 160u, 255u}) {
        for (const float threshold : {0.0f, 0.1f, 0.3f, 0.5f, 0.7f}) {
            EXPECT_LT(farthestFromOne(meanTone(finishGrass, shapeTriangleTip, threshold, seed)),
                      0.015)
                << threshold;
            EXPECT_LT(farthestFromOne(meanTone(finishStalk, shapeQuad, threshold, seed)), 0.001);
        }
        EXPECT_LT(farthestFromOne(meanTone(finishGrass, shapeTriangleTip, 0.9f, seed)), 0.025);
        for (const float threshold : {0.3f, 0.5f, 0.7f, 0.9f})
            EXPECT_LT(farthestFromOne(meanTone(finishPetal, shapeLeaf, threshold, seed)), 0.015)
                << threshold;
        EXPECT_LT(farthestFromOne(meanTone(finishPetal, shapeLeaf, 0.0f, seed)), 0.05);
    }
    // It does something: the tip of some blades dries up, petals are yellower at their centre.
    EXPECT_GT(toneAlong(finishGrass, 1.0f, 255u).x, 1.3f * toneAlong(finishGrass, 1.0f, 255u).y);
    EXPECT_NEAR(toneAlong(finishGrass, 1.0f, 0u).x, 1.0f, 1e-6f);
    EXPECT_LT(toneAlong(finishPetal, 0.0f, 0u).z, 0.7f * toneAlong(finishPetal, 0.0f, 0u).x);
}

TEST(LeafFinish, VeinsKeepTheMeanOfEachCrossSection)
{
    constexpr int points = 20'000;
    for (uint finish = 0; finish <= finishPlain; ++finish)
        for (const float along : {0.05f, 0.3f, 0.55f, 0.9f})
            for (const float pixels : {2.0f, 8.0f, 30.0f, 300.0f})
                for (const uint seed : {3u, 77u, 250u}) {
                    glm::dvec3 tone(0.0);
                    double slope = 0.0;
                    float least = 1.0f;
                    for (int i = 0; i < points; ++i) {
                        const float x = 2.0f * (float(i) + 0.5f) / float(points) - 1.0f;
                        const Veins veins = veinsAt(finish, {x, along}, pixels, seed);
                        tone += glm::dvec3(veins.tone) / double(points);
                        slope += double(veins.slope) / double(points);
                        least = std::min({least, veins.tone.x, veins.tone.y, veins.tone.z});
                    }
                    EXPECT_LT(farthestFromOne(tone), 1e-4) << finish << " at " << along;
                    EXPECT_LT(std::abs(slope), 1e-4) << finish << " at " << along;
                    EXPECT_GT(least, 0.5f);
                    // Nothing is finer than a picture shows.
                    if (pixels < 2.5f) {
                        EXPECT_EQ(least, 1.0f);
                    }
                }
}

TEST(LeafFinish, IsThatOfOutlineAndColour)
{
    Species look = {};
    look.tipColor = vec3(0.2f, 0.3f, 0.05f);
    look.shape = shapeTriangleTip;
    EXPECT_EQ(finishOf(look), finishGrass);
    look.shape = shapeStalkLeaf;
    EXPECT_EQ(finishOf(look), finishGrass);
    look.shape = shapeQuad;
    EXPECT_EQ(finishOf(look), finishStalk);
    look.shape = shapeLeaf;
    EXPECT_EQ(finishOf(look), finishBroad);
    look.tipColor = vec3(0.86f, 0.66f, 0.01f);
    EXPECT_EQ(finishOf(look), finishPetal);
}

// Sum over the hemisphere of what `shine` of a direction gives, per projected solid angle.
template <class Shine>
double overHemisphere(const Shine& shine)
{
    constexpr int rings = 200;
    constexpr int steps = 400;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < steps; ++k) {
            const float z = (float(i) + 0.5f) / float(rings);
            const float side = std::sqrt(1.0f - z * z);
            const auto angle = float(2.0 * finishPi * (double(k) + 0.5) / steps);
            sum += double(shine(vec3(side * std::cos(angle), side * std::sin(angle), z)));
        }
    return sum * 2.0 * finishPi / (double(rings) * steps);
}

vec3 eyeAt(float cosine, float azimuth)
{
    const float side = std::sqrt(1.0f - cosine * cosine);
    return {side * std::cos(azimuth), side * std::sin(azimuth), cosine};
}

// Light that rough facets mirror: Beckmann's distribution, Smith's masking by its exact formula,
// Fresnel's formulas. Times π and the cosine, as coatShine(); veins along y.
double mirroredByFacets(vec3 source, vec3 eye)
{
    const glm::dvec3 l(source);
    const glm::dvec3 v(eye);
    const glm::dvec3 h = glm::normalize(l + v);
    const double ax = double(roughnessAcross);
    const double ay = double(roughnessAlong);
    const double slopes = (h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay)) / (h.z * h.z);
    const double facets = std::exp(-slopes) / (finishPi * ax * ay * std::pow(h.z, 4.0));
    const auto masked = [&](const glm::dvec3& w) {
        const double a = w.z / std::max(std::sqrt(w.x * w.x * ax * ax + w.y * w.y * ay * ay), 1e-9);
        return 0.5 * (std::erf(a) - 1.0 + std::exp(-a * a) / (a * std::sqrt(finishPi)));
    };
    const double cosine = glm::dot(l, h);
    const double g = std::sqrt(1.32 * 1.32 - 1.0 + cosine * cosine);
    const double across = (g - cosine) / (g + cosine);
    const double along = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    const double fresnel = 0.5 * across * across * (1.0 + along * along);
    return finishPi * fresnel * facets / ((1.0 + masked(l) + masked(v)) * 4.0 * v.z);
}

TEST(LeafFinish, CoatMirrorsAsMuchAsItsFacets)
{
    const vec3 up(0.0f, 0.0f, 1.0f);
    const vec3 veins(0.0f, 1.0f, 0.0f);
    for (const float cosine : {1.0f, 0.9f, 0.7f, 0.5f, 0.3f, 0.2f, 0.1f, 0.05f}) {
        double mean = 0.0;
        for (const float azimuth : {0.0f, 0.785f, 1.571f}) {
            const vec3 eye = eyeAt(cosine, azimuth);
            const double mirrored =
                overHemisphere([&](vec3 in) { return coatShine(up, veins, in, eye); }) / finishPi;
            const double facets =
                overHemisphere([&](vec3 in) { return mirroredByFacets(in, eye); }) / finishPi;
            EXPECT_LE(mirrored, 0.35);
            EXPECT_NEAR(mirrored, facets,
                        cosine < 0.1f   ? 0.12
                        : cosine < 0.3f ? 0.07
                                        : 0.015)
                << cosine << ", azimuth " << azimuth;
            mean += mirrored / 4.0 * (azimuth > 0.5f && azimuth < 1.0f ? 2.0 : 1.0);
        }
        EXPECT_NEAR(double(coatAlbedo(cosine)), mean, 0.02) << cosine;
    }
}

TEST(LeafFinish, CoatIsNarrowAlongTheVeinsAndWideAcross)
{
    const vec3 up(0.0f, 0.0f, 1.0f);
    const vec3 veins(0.0f, 1.0f, 0.0f);
    const vec3 source = eyeAt(0.8f, 1.2f);
    const vec3 image(-source.x, -source.y, source.z);
    const float most = coatShine(up, veins, source, image);
    const auto turned = [&](vec3 axis) {
        return coatShine(up, veins, source, glm::normalize(image + 0.5f * axis));
    };
    EXPECT_LT(turned(veins), 0.35f * most);
    EXPECT_GT(turned(vec3(1.0f, 0.0f, 0.0f)), 0.6f * most);
    // Nothing from behind, and no sparks at the horizon.
    EXPECT_EQ(coatShine(up, veins, -up, up), 0.0f);
    for (float cosine = 0.001f; cosine < 1.0f; cosine += 0.01f) {
        const vec3 low = eyeAt(cosine, 0.3f);
        EXPECT_LT(coatShine(up, veins, low, vec3(-low.x, -low.y, low.z)), 13.0f);
    }
}

} // namespace
} // namespace sward::shared
