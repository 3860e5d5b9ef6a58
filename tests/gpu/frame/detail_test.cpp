// Level of detail covers as much ground as all blades; its jumps stay below those of a drive.

#include "core/math/srgb.h"
#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace sward::render {
namespace {

constexpr glm::uvec2 detailSize(96, 64);
constexpr std::uint32_t detailTile = 16; ///< [pixels]
constexpr int frames = 120;
constexpr double way = 6.0; ///< [m] over all frames: blades at every distance from 1 m on pass by

class DetailTest : public test::GpuTest {
protected:
    void driveAndCompare(std::uint32_t samples);
    void measureCoverage(Geometry geometry, bool forCpu = false);
    void measureLeafArea(Geometry geometry, glm::vec2 heights);
};

class LongDetailTest : public DetailTest {};

/// Mean over each tile of `of` applied to the difference of 8-bit channel values; all three
/// channels together.
template <typename Function>
std::vector<glm::dvec3> tileMeans(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                                  Function of)
{
    std::vector<glm::dvec3> means;
    for (std::uint32_t y0 = 0; y0 < detailSize.y; y0 += detailTile)
        for (std::uint32_t x0 = 0; x0 < detailSize.x; x0 += detailTile) {
            glm::ivec3 sum(0);
            for (std::uint32_t y = y0; y < y0 + detailTile; ++y)
                for (std::uint32_t x = x0; x < x0 + detailTile; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const std::size_t i =
                            4 * (std::size_t(y) * detailSize.x + x) + std::size_t(c);
                        sum[c] += of(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i]));
                    }
            means.push_back(glm::dvec3(sum) / double(detailTile * detailTile));
        }
    return means;
}

/// Mean absolute difference of a tile's 8-bit values, the largest of all tiles.
double largestTile(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    double most = 0.0;
    for (const glm::dvec3& mean : tileMeans(a, b, [](int d) { return std::abs(d); }))
        most = std::max(most, (mean.x + mean.y + mean.z) / 3.0);
    return most;
}

/// Mean signed difference of a channel of a tile, the largest of all tiles [8-bit values].
double largestShift(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    double most = 0.0;
    for (const glm::dvec3& mean : tileMeans(a, b, [](int d) { return d; }))
        most = std::max({most, std::abs(mean.x), std::abs(mean.y), std::abs(mean.z)});
    return most;
}

/// Drives three ways with and without level of detail, and compares the sums of their largest
/// jumps.
void DetailTest::driveAndCompare(std::uint32_t samples)
{
    const field::Field field = test::makeField({.blades = 4000,
                                                .extent = 40.0f,
                                                .heightLow = 0.3f,
                                                .heightHigh = 0.6f,
                                                .widthLow = 0.02f,
                                                .widthHigh = 0.03f});
    FieldRenderer renderer(device(), field::viewOf(field), {.samples = samples});
    test::Picture picture(context(), detailSize);
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.winds.clear();
    settings.exposure = 1.0f;
    std::array<double, 2> largest{};
    // A maximum is a matter of chance: several ways are compared together.
    for (const double x : {-1.7, 0.3, 2.3})
        for (const bool levelOfDetail : {false, true}) {
            settings.levelOfDetail = levelOfDetail;
            double jump = 0.0;
            std::vector<std::byte> before;
            for (int frame = 0; frame < frames; ++frame) {
                Camera camera;
                const double z = 18.0 - way * frame / frames;
                camera.eye = {x, 1.2, z};
                camera.target = {x, 0.0, z - 5.0};
                camera.fovY = 50.0f;
                picture.draw(renderer, camera, settings, 1.0);
                std::vector<std::byte> now = picture.pixels();
                if (!before.empty())
                    jump = std::max(jump, largestTile(before, now));
                before = std::move(now);
            }
            largest[levelOfDetail ? 1 : 0] += jump;
        }
    EXPECT_GT(largest[0], 1.0) << "the camera moves";
    EXPECT_LE(largest[1], 1.1 * largest[0]) << samples << " samples";
}

TEST_F(DetailTest, ShowsNoLargerJumpsThanWithoutLevelOfDetail)
{
    driveAndCompare(4);
}

TEST_F(LongDetailTest, ShowsNoLargerJumpsWithOneSampleAPixel)
{
    driveAndCompare(1);
}

constexpr float detailSide = 60.0f; ///< [m] of the flat field
constexpr std::size_t bands = 8;
constexpr glm::uvec2 bandSize(128, 80);

/// Light of each of 8 bands of rows from the lower rim of the picture to `horizon`.
std::array<double, bands> lightOf(const std::vector<std::byte>& pixels, std::uint32_t horizon)
{
    std::array<double, bands> sums{};
    const auto rows = std::uint32_t((bandSize.y - horizon) / bands);
    for (std::uint32_t y = horizon; y < horizon + bands * rows; ++y)
        for (std::uint32_t x = 0; x < bandSize.x; ++x)
            sums[(y - horizon) / rows] += double(linearOf(
                float(std::to_integer<int>(pixels[4 * (std::size_t(y) * bandSize.x + x) + 1])) /
                255.0f));
    return sums;
}

void DetailTest::measureCoverage(Geometry geometry, bool forCpu)
{
    // Black blades on bright ground: the missing light is the covered area.
    std::array<double, bands> ground{};
    std::array<double, bands> all{};
    std::array<double, bands> some{};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        field::Field field = test::makeField({.blades = 30'000,
                                              .extent = detailSide,
                                              .heightLow = 0.3f,
                                              .heightHigh = 0.6f,
                                              .widthLow = 0.02f,
                                              .widthHigh = 0.03f,
                                              .seed = seed});
        for (field::Species& species : field.species) {
            species.look.rootColor = species.look.tipColor = glm::vec3(0.0f);
            species.look.groundTint = species.look.colorVariation = species.look.gloss = 0.0f;
            species.look.dryness = species.look.translucency = 0.0f;
        }
        FieldRenderer renderer(device(), field::viewOf(field),
                               {.samples = 4, .geometry = geometry, .rastersForCpu = forCpu});
        test::Picture picture(context(), bandSize);
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.winds.clear();
        settings.fogDensity = 0.0f;
        // White ground: 8 bits round grey between two codes equally for all pixels, but not the
        // mixed and filtered blades; the error would be a tenth of the coverage.
        settings.exposure = 1000.0f;
        settings.environment.drawDistance = 1e6f;
        FrameSettings without = settings;
        without.buckets = {1, 1e-3f};
        FrameSettings whole = settings;
        whole.levelOfDetail = false;
        whole.cullMask &= ~cullOrientation;
        for (int view = 0; view < 8; ++view) {
            Camera camera;
            camera.eye = {3.0 * (view - 3.5), 3.0, 0.5 * detailSide - 1.0};
            camera.target = {3.0 * (view - 3.5), 0.0, 0.25 * detailSide};
            camera.fovY = 40.0f;
            const glm::vec4 rim = viewMatrices(camera, {}, bandSize, {}).viewProjection *
                                  glm::vec4(camera.eye.x, 0.0f, -0.49f * detailSide, 1.0f);
            const auto horizon = std::uint32_t((0.5f + 0.5f * rim.y / rim.w) * bandSize.y) + 1;
            const auto add = [&](const FrameSettings& how, std::array<double, bands>& sums) {
                picture.draw(renderer, camera, how, 1.0);
                const auto light = lightOf(picture.pixels(), horizon);
                for (std::size_t band = 0; band < bands; ++band)
                    sums[band] += light[band];
            };
            add(without, ground);
            add(whole, all);
            add(settings, some);
        }
    }
    for (std::size_t band = 0; band < bands; ++band) {
        const double wanted = 1.0 - all[band] / ground[band];
        const double found = 1.0 - some[band] / ground[band];

        EXPECT_GT(wanted, 0.02);
        EXPECT_NEAR(found / wanted, 1.0, 0.03) << "band " << band << " from the far end";
    }
}

TEST_F(LongDetailTest, TessellatedGrassHidesAsMuchOfTheGroundAtEveryDistance)
{
    measureCoverage(Geometry::tessellation);
}

TEST_F(DetailTest, RasterisedGrassHidesAsMuchOfTheGroundAtEveryDistance)
{
    measureCoverage(Geometry::raster);
}

/// Of small blades, which these are, both methods draw the same bytes (raster_for_cpu_test.cpp).
TEST_F(LongDetailTest, GrassRasterisedForACpuHidesAsMuchOfTheGroundAtEveryDistance)
{
    measureCoverage(Geometry::raster, true);
}

/// Tests dense grass of these heights [m], viewed so flat that a ray to the far end crosses eighty
/// blade cross-sections. Hidden blades are left out, and no channel of a tile shifts by more than
/// 2.75: with light by their position the far blades would be darker; with unchanged heights the
/// tessellator would shift a tile by more.
void DetailTest::measureLeafArea(Geometry geometry, glm::vec2 heights)
{
    field::Field field = test::makeField({.blades = 800'000,
                                          .extent = 80.0f,
                                          .heightLow = heights.x,
                                          .heightHigh = heights.y,
                                          .widthLow = 0.08f,
                                          .widthHigh = 0.08f});
    // Colours by chance would be noise between the pictures.
    field.species[0].look.colorVariation = 0.0f;
    Camera camera;
    camera.eye = {0.0, 1.7, 39.5};
    camera.target = {0.0, 0.9, 0.0};
    camera.fovY = 20.0f;
    FieldRenderer renderer(device(), field::viewOf(field), {.samples = 4, .geometry = geometry});
    test::Picture picture(context(), detailSize);
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.winds.clear();
    std::array<std::uint64_t, 2> drawn{};
    std::array<std::vector<std::byte>, 2> pixels;
    for (const bool leavesOut : {false, true}) {
        settings.maxLeafArea = leavesOut ? FrameSettings().maxLeafArea : 0.0f;
        picture.draw(renderer, camera, settings, 1.0);
        drawn.at(leavesOut ? 1 : 0) = renderer.stats(0).drawn;
        pixels.at(leavesOut ? 1 : 0) = picture.pixels();
    }
    EXPECT_LT(double(drawn[1]), 0.35 * double(drawn[0]));
    EXPECT_GT(drawn[1], 0u);
    EXPECT_LE(largestShift(pixels[0], pixels[1]), 2.75);
}

TEST_F(DetailTest, WhatIsHiddenByOtherGrassIsLeftOutWithoutATrace)
{
    measureLeafArea(Geometry::raster, {0.6f, 1.2f});
}

TEST_F(LongDetailTest, WhatIsHiddenByOtherGrassIsLeftOutOfTessellatedGrassWithoutATrace)
{
    measureLeafArea(Geometry::tessellation, {0.6f, 1.2f});
}

TEST_F(LongDetailTest, OfGrassOfOneHeightNoTraceIsLeftEither)
{
    // Raised and lit like blades of all heights, they would be darker by 4.
    for (const Geometry geometry : {Geometry::raster, Geometry::tessellation}) {
        SCOPED_TRACE(nameOf(geometry));
        measureLeafArea(geometry, {0.9f, 0.9f});
    }
}

} // namespace
} // namespace sward::render
