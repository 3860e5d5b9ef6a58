// Grass is as bright as a reference at every distance: level of detail causes no visible ring by
// thinning, widening and softening.

#include "core/math/srgb.h"
#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace sward::render {
namespace {

constexpr std::size_t rings = 8;
constexpr glm::uvec2 luminanceSize(128, 80);
constexpr float luminanceSide = 40.0f; ///< [m] of the flat field
constexpr double nearest = 2.5;        ///< [m] from the eye's foot to the first ring
/// [m] Blades are 0.06 pixels wide there, one in five is drawn. Nearer to the far edge the sky
/// enters the filter of soft pixels.
constexpr double farthest = 26.0;

class LuminanceTest : public test::GpuTest {};

using Rings = std::array<double, rings>;

/// The ring of the flat ground at height 0 that a place of the picture shows.
std::optional<std::size_t> ringAt(const Camera& camera, double x, double y)
{
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 above = glm::cross(right, ahead);
    const double slope = std::tan(0.5 * double(camera.fovY) * 3.14159265358979 / 180.0);
    const glm::dvec3 ray = ahead +
                           (2.0 * x - 1.0) * slope * luminanceSize.x / luminanceSize.y * right +
                           (1.0 - 2.0 * y) * slope * above;
    if (ray.y >= 0.0)
        return std::nullopt;
    const glm::dvec3 ground = camera.eye - camera.eye.y / ray.y * ray;
    const double distance = std::hypot(ground.x - camera.eye.x, ground.z - camera.eye.z);
    const double ring = rings * std::log(distance / nearest) / std::log(farthest / nearest);
    const bool isInside =
        std::abs(ground.x) < 0.5 * luminanceSide && std::abs(ground.z) < 0.5 * luminanceSide;
    if (ring < 0.0 || ring >= double(rings) || !isInside)
        return std::nullopt;
    return std::size_t(ring);
}

/// Sums of ITU-R BT.709 luminance, linear.
void add(Rings& sums, const Camera& camera, const std::vector<std::byte>& pixels, double weight)
{
    const auto linear = [](std::byte value) {
        return double(linearOf(float(std::to_integer<int>(value)) / 255.0f));
    };
    for (std::uint32_t y = 0; y < luminanceSize.y; ++y)
        for (std::uint32_t x = 0; x < luminanceSize.x; ++x)
            if (const auto ring =
                    ringAt(camera, (x + 0.5) / luminanceSize.x, (y + 0.5) / luminanceSize.y)) {
                const std::size_t i = 4 * (std::size_t(y) * luminanceSize.x + x);
                sums[*ring] +=
                    weight * (0.2126 * linear(pixels[i]) + 0.7152 * linear(pixels[i + 1]) +
                              0.0722 * linear(pixels[i + 2]));
            }
}

TEST_F(LuminanceTest, StaysNearAReferenceInEachRing)
{
    // For a CPU the rasteriser gives the same bytes (raster_for_cpu_test.cpp).
    const std::array<FieldRenderer::Settings, 4> ways{
        {{.samples = 1, .geometry = Geometry::raster, .rastersForCpu = false},
         {.samples = 4, .geometry = Geometry::raster, .rastersForCpu = false},
         {.samples = 1, .geometry = Geometry::tessellation},
         {.samples = 4, .geometry = Geometry::tessellation}}};
    test::Picture picture(context(), luminanceSize);
    Rings wanted{};
    std::array<Rings, ways.size()> found{};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const field::Field field = test::makeField({.blades = 48'000,
                                                    .extent = luminanceSide,
                                                    .heightLow = 0.2f,
                                                    .heightHigh = 0.4f,
                                                    .widthLow = 0.01f,
                                                    .widthHigh = 0.02f,
                                                    .seed = seed});
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.winds.clear();
        settings.environment.drawDistance = 1e6f;
        Camera camera;
        camera.eye = {0.0, 2.0, 0.5 * luminanceSide - 1.0};
        camera.target = {0.0, 0.0, 0.5 * luminanceSide - 7.0};
        camera.fovY = 45.0f;
        const auto sum = [&](const FieldRenderer::Settings& way, const FrameSettings& how,
                             std::uint32_t pictures, Rings& sums) {
            FieldRenderer renderer(device(), field::viewOf(field), way);
            for (std::uint32_t i = 0; i < pictures; ++i) {
                const glm::vec2 jitter(float(i) / float(pictures) - 0.5f,
                                       std::fmod(0.618f * float(i), 1.0f) - 0.5f);
                picture.draw(renderer, camera, how, 1.0, jitter);
                add(sums, camera, picture.pixels(), 1.0 / pictures);
            }
        };
        FrameSettings all = settings;
        all.cullMask = 0;
        all.levelOfDetail = false;
        all.tessellationLevel = 16;
        sum(ways[0], all, 24, wanted);
        for (std::size_t way = 0; way < ways.size(); ++way)
            sum(ways[way], settings, 4, found[way]);
    }
    for (std::size_t way = 0; way < ways.size(); ++way)
        for (std::size_t ring = 0; ring < rings; ++ring) {
            ASSERT_GT(wanted[ring], 0.0) << ring;
            // In the last ring widened blades cover a little more than thin ones, and are brighter
            // than the ground.
            EXPECT_NEAR(found[way][ring] / wanted[ring], 1.0, ring + 1 < rings ? 0.03 : 0.045)
                << "ring " << ring << ", " << ways[way].samples << " samples, "
                << (ways[way].geometry == Geometry::raster ? "rasterised" : "tessellated");
        }
}

} // namespace
} // namespace sward::render
