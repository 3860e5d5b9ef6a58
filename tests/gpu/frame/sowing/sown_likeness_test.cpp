// A field that is sown looks as the same field does that is stored as a whole.
#include "field/seeds/seeds.h"
#include "gpu/frame/likeness.h"
#include "gpu/frame/picture.h"
#include "gpu/frame/sowing/sown_meadow.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 sownSize(480, 270);

/// What a sown field must reach.
constexpr double maxError = 0.02;     ///< 1 − SSIM
constexpr double maxBrighter = 0.005; ///< of the mean luminance

/// Nearer than this [m], eyes look down between blades, whose shade is told by the leaf area of the
/// stored ones: chance makes it lighter.
constexpr double near = 20.0;
constexpr double maxBrighterNear = 0.015;

constexpr double maxJump = 1.1; ///< of a block, relative to that of the stored field

constexpr std::uint64_t roomForAll = std::uint64_t(4) << 30;

/// Of test::meshes::hills() [m].
double heightAt(double x, double z)
{
    return 5.0 * std::sin(0.11 * x + 0.3) * std::cos(0.07 * z) + 2.0 * std::sin(0.31 * z - 0.1 * x);
}

double sownGreen(const std::vector<std::byte>& pixels, std::uint32_t x, std::uint32_t y)
{
    return std::to_integer<int>(pixels[4 * (std::size_t(y) * sownSize.x + x) + 1]);
}

class SownLikenessTest : public test::GpuTest {
protected:
    static FieldRenderer::Settings drawing(std::uint64_t sownBytes)
    {
        FieldRenderer::Settings settings;
        settings.samples = 4;
        settings.geometry = Geometry::raster;
        settings.largestTarget = sownSize;
        settings.waitsForDisk = true;
        settings.sownBytes = sownBytes;
        settings.sowThreads = 2;
        return settings;
    }

    /// Seen from `distance` [m], the lower the nearer.
    static Camera from(double distance)
    {
        const double pitch = glm::radians(distance < 5.0    ? 45.0
                                          : distance < 20.0 ? 20.0
                                          : distance < 90.0 ? 15.0
                                                            : 25.0);
        Camera camera;
        camera.target = {0.0, heightAt(0.0, 0.0), 0.0};
        camera.eye = camera.target + distance * glm::dvec3(0.0, std::sin(pitch), std::cos(pitch));
        camera.fovY = distance < 90.0 ? 40.0f : 12.0f;
        return camera;
    }

    void compare(const test::SownMeadow& meadow, const std::vector<double>& distances)
    {
        FieldRenderer whole(device(), field::viewOf(meadow.whole), drawing(0));
        FieldRenderer sown(device(), field::viewOf(meadow.seeded), drawing(roomForAll));
        ASSERT_TRUE(sown.isSown());
        const FrameSettings settings = FrameSettings::of(field::viewOf(meadow.whole));
        test::Picture picture(context(), sownSize);
        for (const double distance : distances) {
            picture.draw(whole, from(distance), settings, 1.0);
            const auto expected = picture.pixels();
            picture.draw(sown, from(distance), settings, 1.0);
            const auto found = picture.pixels();
            const double error = test::structuralError(found, expected, sownSize);
            const double brighter =
                test::meanLuminance(found) / test::meanLuminance(expected) - 1.0;
            EXPECT_LT(error, maxError) << distance << " m";
            EXPECT_LT(std::abs(brighter), distance < near ? maxBrighterNear : maxBrighter)
                << distance << " m";
        }
    }

    /// The largest change of a 16 × 16 block's mean green from a frame to the next, on a walk.
    double largestJump(FieldRenderer& renderer, const FrameSettings& settings, int frames)
    {
        constexpr std::uint32_t block = 16;
        constexpr double step = 3.0 / 60.0; // [m] a frame
        const auto blocksOf = [&](const std::vector<std::byte>& pixels) {
            std::vector<double> means;
            for (std::uint32_t y = 0; y + block <= sownSize.y; y += block)
                for (std::uint32_t x = 0; x + block <= sownSize.x; x += block) {
                    double sum = 0.0;
                    for (std::uint32_t v = y; v < y + block; ++v)
                        for (std::uint32_t u = x; u < x + block; ++u)
                            sum += sownGreen(pixels, u, v);
                    means.push_back(sum / (block * block));
                }
            return means;
        };
        test::Picture picture(context(), sownSize);
        std::vector<double> before;
        double largest = 0.0;
        for (int frame = 0; frame < frames; ++frame) {
            Camera camera;
            const double z = 12.0 - step * frame;
            camera.eye = {1.0, heightAt(1.0, z) + 1.7, z};
            camera.target = camera.eye + glm::dvec3(0.0, -0.25, -1.0);
            camera.fovY = 45.0f;
            picture.draw(renderer, camera, settings, 1.0 + frame / 60.0);
            const std::vector<double> now = blocksOf(picture.pixels());
            for (std::size_t i = 0; i < before.size(); ++i)
                largest = std::max(largest, std::abs(now[i] - before[i]));
            before = now;
        }
        return largest;
    }

    void walk(const test::SownMeadow& meadow, std::uint64_t sownBytes, int frames)
    {
        const FrameSettings settings = FrameSettings::of(field::viewOf(meadow.whole));
        FieldRenderer whole(device(), field::viewOf(meadow.whole), drawing(0));
        const double expected = largestJump(whole, settings, frames);
        FieldRenderer sown(device(), field::viewOf(meadow.seeded), drawing(sownBytes));
        const double found = largestJump(sown, settings, frames);
        EXPECT_GT(expected, 1.0) << "of 255";
        EXPECT_LT(found, maxJump * expected);
    }
};

class LongSownLikenessTest : public SownLikenessTest {};

TEST_F(SownLikenessTest, HasLightAndStructureOfTheStoredFieldNearAndFar)
{
    compare(test::sownMeadow(32.0, 16, 600.0, 0.25), {2.0, 40.0});
}

TEST_F(LongSownLikenessTest, HasLightAndStructureOfTheStoredFieldAtEveryDistance)
{
    compare(test::sownMeadow(32.0, 16, 600.0, 0.25), {2.0, 10.0, 40.0, 200.0});
}

TEST_F(LongSownLikenessTest, WalksWithoutJumps)
{
    walk(test::sownMeadow(32.0, 16, 600.0, 1.0 / 16.0), std::uint64_t(20) << 20, 16);
}

} // namespace
} // namespace sward::render
