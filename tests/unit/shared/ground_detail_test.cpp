// Detail of bare ground has the mean of the plain ground, and ends where a pixel shows none of it.

#include "core/random.h"
#include "shaders/shared/look/ground_detail.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::shared {
namespace {

constexpr vec3 up(0.0f, 1.0f, 0.0f);
constexpr float size_ = 0.2f;

/// A place on a plane through the lattices of all noises at a slant.
vec3 placeOf(uint i, float extent)
{
    return {extent * (float(uniform(5, i, 0)) - 0.5f), 1.37f,
            extent * (float(uniform(5, i, 1)) - 0.5f)};
}

struct Mean {
    dvec3 albedo{0.0};
    double brightness = 0.0;
    dvec3 slope{0.0};
    double deviation = 0.0; ///< of the brightness of albedo · brightness, relative to the mean
};

Mean meanOf(vec3 albedo, float pixel)
{
    constexpr uint count = 150'000;
    Mean mean;
    double squares = 0.0;
    double sum = 0.0;
    for (uint i = 0; i < count; ++i) {
        const GroundDetail detail = groundDetail(placeOf(i, 300.0f), up, up, albedo, size_, pixel);
        mean.albedo += dvec3(detail.albedo);
        mean.brightness += double(detail.brightness);
        mean.slope += dvec3(detail.slope);
        const double light = double(detail.albedo.y) * double(detail.brightness);
        sum += light;
        squares += light * light;
        EXPECT_GE(std::min({detail.albedo.x, detail.albedo.y, detail.albedo.z}), 0.0f);
        EXPECT_LE(std::max({detail.albedo.x, detail.albedo.y, detail.albedo.z}), 1.0f);
        EXPECT_GT(detail.brightness, 0.3f);
    }
    mean.albedo /= double(count);
    mean.brightness /= double(count);
    mean.slope /= double(count);
    mean.deviation =
        std::sqrt(std::max(squares / count - sum * sum / count / count, 0.0)) / (sum / count);
    return mean;
}

TEST(GroundDetail, HasTheMeanOfThePlainGround)
{
    for (const vec3 albedo :
         {vec3(0.085f, 0.078f, 0.036f), vec3(0.2f, 0.15f, 0.1f), vec3(0.03f, 0.03f, 0.032f),
          vec3(0.48f, 0.37f, 0.21f), vec3(0.8f, 0.78f, 0.74f)})
        for (const float pixel : {0.0005f, 0.004f, 0.012f}) {
            const Mean mean = meanOf(albedo, pixel);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(mean.albedo[c] / double(albedo[c]), 1.0, 0.01) << pixel;
                EXPECT_NEAR(mean.slope[c], 0.0, 0.01) << pixel;
            }
            EXPECT_NEAR(mean.brightness, 1.0, 0.01) << pixel;
        }
}

TEST(GroundDetail, IsSeenNearByAndGoneFarAway)
{
    const vec3 earth(0.085f, 0.078f, 0.036f);
    EXPECT_GT(meanOf(earth, 0.001f).deviation, 0.2);
    // Snow and chalk are smooth.
    EXPECT_LT(meanOf(vec3(0.8f), 0.001f).deviation, 0.1);
    // It fades out.
    double before = 1.0;
    for (const float pixel : {0.001f, 0.004f, 0.016f, 0.05f}) {
        const double now = meanOf(earth, pixel).deviation;
        EXPECT_LT(now, before) << pixel;
        before = now;
    }
    for (uint i = 0; i < 1000; ++i) {
        const GroundDetail detail =
            groundDetail(placeOf(i, 300.0f), up, up, earth, size_, damp * 0.4f * size_);
        EXPECT_EQ(detail.albedo, earth);
        EXPECT_EQ(detail.brightness, 1.0f);
        EXPECT_EQ(detail.slope, vec3(0.0f));
    }
}

TEST(GroundDetail, StonesAndStrawsLieOnGentleSlopesOfSoil)
{
    const auto differs = [](vec3 normal, vec3 albedo) {
        uint count = 0;
        for (uint i = 0; i < 4000; ++i) {
            const vec3 place = placeOf(i, 50.0f);
            count +=
                groundDetail(place, normal, up, albedo, size_, 0.001f).albedo != albedo ? 1u : 0u;
        }
        return count;
    };
    EXPECT_GT(differs(up, vec3(0.1f)), 3900u);
    EXPECT_EQ(differs(vec3(1.0f, 0.0f, 0.0f), vec3(0.1f)), 0u);
    // Green ground is turf.
    EXPECT_EQ(differs(up, vec3(0.05f, 0.12f, 0.03f)), 0u);
}

TEST(GroundDetail, RaggedEdgesCoverTheShareOfAnEvenOne)
{
    for (const float cell : {0.3f, 8.0f})
        for (const float share : {0.0f, 0.05f, 0.2f, 0.5f, 0.65f, 0.8f, 0.95f, 1.0f})
            for (const float pixel : {0.002f, 0.03f}) {
                constexpr uint count = 30'000;
                double sum = 0.0;
                double squares = 0.0;
                for (uint i = 0; i < count; ++i) {
                    const float covered =
                        raggedShare(share, placeOf(i, 3000.0f), cell, size_, pixel);
                    EXPECT_GE(covered, 0.0f);
                    EXPECT_LE(covered, 1.0f);
                    sum += double(covered);
                    squares += double(covered - share) * double(covered - share);
                }
                EXPECT_NEAR(sum / count, double(share), 0.035) << cell << " " << pixel;
                // Near the eye a place is nearly covered or nearly bare.
                if (pixel < 0.01f && share > 0.0f && share <= 0.65f) {
                    const double most = double(share * (1.0f - share));
                    EXPECT_GT(squares / count, 0.3 * most) << share;
                }
            }
    // Without grass, and from afar, the even share is left.
    EXPECT_EQ(raggedShare(0.5f, vec3(1.0f), 0.3f, size_, 0.2f), 0.5f);
    EXPECT_EQ(raggedShare(0.0f, vec3(1.0f), 0.3f, size_, 0.001f), 0.0f);
}

} // namespace
} // namespace sward::shared
