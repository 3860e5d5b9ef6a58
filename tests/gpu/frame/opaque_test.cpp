// Ground and colliders by compute shaders: equal to the graphics pipeline, and without holes.

#include "picture.h"
#include "shaders/shared/opaque.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace sward::render {
namespace {

using Pixels = std::vector<std::byte>;

int valueAt(const Pixels& pixels, std::size_t i)
{
    return std::to_integer<int>(pixels[i]);
}

/// Pixels in which a channel differs by more than `tolerance` of 255.
std::size_t farPixels(const Pixels& a, const Pixels& b, int tolerance)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        bool isFar = false;
        for (std::size_t c = 0; c < 3; ++c)
            isFar = isFar || std::abs(valueAt(a, i + c) - valueAt(b, i + c)) > tolerance;
        count += isFar ? 1 : 0;
    }
    return count;
}

shared::GroundVertex cornerAt(glm::vec3 position, glm::vec2 uv = glm::vec2(0.0f))
{
    shared::GroundVertex corner = {};
    corner.position = position;
    corner.normal = shared::encodeNormal32(glm::vec3(0.0f, 1.0f, 0.0f));
    corner.uv = uv;
    corner.color = 0xffffffffu;
    return corner;
}

void putTriangle(field::DisplayGround& ground, std::array<glm::vec3, 3> corners)
{
    for (const glm::vec3& corner : corners) {
        ground.indices.push_back(static_cast<std::uint32_t>(ground.vertices.size()));
        ground.vertices.push_back(cornerAt(corner));
    }
}

/// Assigns one material to all triangles.
void endGround(field::DisplayGround& ground)
{
    ground.ranges = {{.level = 0,
                      .material = 0,
                      .firstIndex = 0,
                      .indexCount = static_cast<std::uint32_t>(ground.indices.size())}};
}

/// A field without blades; the caller adds the ground.
field::Field fieldWithoutBlades()
{
    field::Field field = test::makeField({.blades = 16, .extent = 1.0f});
    field.ground.vertices.clear();
    field.ground.indices.clear();
    field.ground.ranges.clear();
    return field;
}

/// Settings without blades and air.
FrameSettings bareSettings(const field::Field& field)
{
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.environment.drawDistance = 1e-3f;
    settings.fogDensity = 0.0f;
    settings.clouds = 0.0f;
    return settings;
}

class OpaqueTest : public test::GpuTest {
protected:
    static void expectCrowdDrawn(std::uint32_t large, std::uint32_t middle);
    static void expectClosed(int apart);
};

class LongOpaqueTest : public OpaqueTest {};

/// Waves of squares, 40 m wide; each of `images` images covers a part.
field::Field wavesWith(std::uint32_t images, std::uint32_t cells)
{
    field::Field field = fieldWithoutBlades();
    field::DisplayGround& ground = field.ground;
    const float step = 40.0f / static_cast<float>(cells);
    for (std::uint32_t row = 0; row <= cells; ++row)
        for (std::uint32_t column = 0; column <= cells; ++column) {
            const float x = step * static_cast<float>(column) - 20.0f;
            const float z = step * static_cast<float>(row) - 20.0f;
            ground.vertices.push_back(cornerAt(
                {x, 2.0f * std::sin(0.5f * x) * std::cos(0.4f * z), z}, {0.11f * x, 0.13f * z}));
        }
    const shared::GroundMaterial plain = ground.materials.at(0);
    ground.materials.clear();
    for (std::uint32_t image = 0; image <= images; ++image) {
        shared::GroundMaterial material = plain;
        material.image = image < images ? image : shared::noImage;
        material.flags = image % 2 == 0 ? 0u : shared::groundDoubleSided;
        ground.materials.push_back(material);
        const auto first = static_cast<std::uint32_t>(ground.indices.size());
        for (std::uint32_t square = image; square < cells * cells; square += images + 1) {
            const std::uint32_t a = square / cells * (cells + 1) + square % cells;
            const std::uint32_t b = a + cells + 1;
            for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1})
                ground.indices.push_back(i);
        }
        ground.ranges.push_back(
            {.level = 0,
             .material = image,
             .firstIndex = first,
             .indexCount = static_cast<std::uint32_t>(ground.indices.size()) - first});
    }
    for (std::uint32_t image = 0; image < images; ++image) {
        field::Image made{.width = 8, .height = 8, .rgba = {}};
        for (std::uint32_t texel = 0; texel < 64; ++texel)
            for (const std::uint32_t channel : {60u + 17u * image, 220u - 13u * image,
                                                30u + (71u * image + 23u * texel) % 200u, 255u})
                made.rgba.push_back(static_cast<std::uint8_t>(channel));
        ground.images.push_back(std::move(made));
    }
    return field;
}

Camera around(int i)
{
    const double turn = 2.0 * std::numbers::pi * i / 12.0;
    Camera camera;
    // From below, among and above the waves: near ones reach through the near plane.
    camera.eye = {15.0 * std::cos(turn), -1.5 + 0.5 * i, 15.0 * std::sin(3.0 * turn)};
    camera.target = camera.eye + glm::dvec3(std::sin(5.0 * turn), -0.25, std::cos(2.0 * turn));
    return camera;
}

TEST_F(OpaqueTest, LooksAsByTheGraphicsPipeline)
{
    // More images than a dispatch supports, and triangles of some and of thousands of pixels.
    for (const std::uint32_t cells : {5u, 60u}) {
        const field::Field field = wavesWith(10, cells);
        for (const std::uint32_t samples : {1u, 4u}) {
            const auto rendererOf = [&](Geometry geometry, bool forCpu = false) {
                return FieldRenderer(
                    device(), field::viewOf(field),
                    {.samples = samples, .geometry = geometry, .rastersForCpu = forCpu});
            };
            FieldRenderer raster = rendererOf(Geometry::raster);
            FieldRenderer forCpu = rendererOf(Geometry::raster, true);
            FieldRenderer pipeline = rendererOf(Geometry::tessellation);
            FrameSettings settings = bareSettings(field);
            settings.colliders = {
                {.from = {3.0, 3.0, 2.0}, .to = {3.0, 3.0, 2.0}, .radius = 2.0, .path = {}},
                {.from = {-4.0, 2.0, 0.0}, .to = {0.0, 4.0, 1.0}, .radius = 1.0, .path = {}}};
            test::Picture byCompute(context(), {211, 131});
            test::Picture byPipeline(context(), {211, 131});
            std::size_t far = 0;
            std::size_t seen = 0;
            for (const int i : samples == 1 ? std::array{1, 7} : std::array{4, 10}) {
                settings.debug = i >= 7 ? DebugMode::wind : DebugMode::none;
                byCompute.draw(raster, around(i), settings, 1.0);
                byPipeline.draw(pipeline, around(i), settings, 1.0);
                const Pixels computed = byCompute.pixels();
                far += farPixels(computed, byPipeline.pixels(), 6);
                byCompute.draw(forCpu, around(i), settings, 1.0);
                EXPECT_EQ(test::differingPixels(computed, byCompute.pixels()), 0u)
                    << cells << " squares, " << samples << " samples, camera " << i;
                seen += 211u * 131u;
            }
            // With one sample, samples on an edge may differ (1/256 pixel). With four samples, the
            // pipeline extrapolates beyond a triangle's edge that hides the pixel centre.
            EXPECT_LT(far, samples == 1 ? seen / 10000 : seen / 500)
                << cells << " squares, " << samples << " samples";
        }
    }
}

/// Makes `count` triangles, each half of a square of `side` m and nearer to +z than the one before.
/// One of 97 shows its front.
void putCrowd(field::DisplayGround& ground, std::uint32_t count, float side)
{
    const auto across = static_cast<std::uint32_t>(6.5f / side);
    const glm::vec3 right = {side, 0.0f, 0.0f};
    const glm::vec3 up = {0.0f, side, 0.0f};
    const float half = 0.5f * side * static_cast<float>(across);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner = {side * static_cast<float>(i % across) - half,
                                  side * static_cast<float>(i / across % across) - half,
                                  1e-6f * static_cast<float>(i)};
        if (i % 97 == 0)
            putTriangle(ground, {corner, corner + right, corner + up});
        else
            putTriangle(ground, {corner, corner + up, corner + right});
    }
}

void OpaqueTest::expectCrowdDrawn(std::uint32_t large, std::uint32_t middle)
{
    // A metre is 24 pixels: boxes of 41 × 41 pixels, and of 10 × 10, all of them in the picture.
    // The last triangles are the nearest; they find the lists full.
    field::Field field = fieldWithoutBlades();
    putCrowd(field.ground, large, 1.4f);
    putCrowd(field.ground, middle, 0.3f);
    endGround(field.ground);
    for (std::size_t i = 0; i < field.ground.vertices.size(); ++i)
        field.ground.vertices[i].color =
            0xff000000u | (0x9e3779b9u * static_cast<std::uint32_t>(i / 3) >> 8u);
    const FrameSettings settings = bareSettings(field);
    Camera camera;
    // Tilt the view, so that no edge runs through pixel centres.
    camera.eye = {0.0, 0.0, 10.0};
    camera.target = {0.0, 0.0, 0.0};
    camera.up = {0.3f, 1.0f, 0.0f};
    std::vector<Pixels> pictures;
    for (const Geometry geometry : {Geometry::raster, Geometry::tessellation}) {
        FieldRenderer renderer(device(), field::viewOf(field),
                               {.samples = 1, .geometry = geometry});
        test::Picture picture(context(), {200, 200});
        picture.draw(renderer, camera, settings, 1.0);
        pictures.push_back(picture.pixels());
    }
    // A sample within 1/256 pixel of an edge may lie on either side.
    EXPECT_LT(farPixels(pictures[0], pictures[1], 6), 200u * 200u / 400u);
}

TEST_F(OpaqueTest, DrawsWhatHasNoRoomInTheListOfLargeTriangles)
{
    expectCrowdDrawn(shared::maxLargeTriangles + 4000, 0);
}

TEST_F(LongOpaqueTest, DrawsWhatHasNoRoomInItsLists)
{
    // Some work-groups have more clusters than one.
    constexpr std::uint32_t large = shared::maxLargeTriangles + 4000;
    constexpr std::uint32_t middle = 2 * shared::maxMiddleTriangles + 4000;
    static_assert(large + middle > (shared::maxOpaqueGroups + 100) * shared::clusterTriangles);
    expectCrowdDrawn(large, middle);
}

/// `apart`: from one of 24 cameras to the next that looks.
void OpaqueTest::expectClosed(int apart)
{
    // A sphere from inside, with triangles of all shapes: black, with a bright sky behind it.
    field::Field field = fieldWithoutBlades();
    constexpr int rings = 40;
    constexpr int segments = 70;
    const auto place = [](int ring, int segment) {
        const double down = std::numbers::pi * std::pow(double(ring) / rings, 1.7);
        const double turn = 2.0 * std::numbers::pi * (segment % segments) / segments;
        // A pole must be exactly one point.
        const double reach = ring == 0 || ring == rings ? 0.0 : std::sin(down);
        return glm::vec3(glm::dvec3(17.3 * reach * std::cos(turn), 17.3 * std::cos(down),
                                    17.3 * reach * std::sin(turn)));
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int segment = 0; segment < segments; ++segment) {
            putTriangle(field.ground,
                        {place(ring, segment), place(ring, segment + 1), place(ring + 1, segment)});
            putTriangle(field.ground, {place(ring, segment + 1), place(ring + 1, segment + 1),
                                       place(ring + 1, segment)});
        }
    endGround(field.ground);
    field.ground.materials.at(0).baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    field.ground.materials.at(0).flags = shared::groundDoubleSided;
    FrameSettings settings = bareSettings(field);
    settings.sunColor = glm::vec3(0.0f);
    settings.skyColor = glm::vec3(50.0f);
    settings.groundColor = glm::vec3(50.0f);
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer raster(device(), field::viewOf(field),
                             {.samples = samples, .geometry = Geometry::raster});
        test::Picture picture(context(), {257, 173});
        for (int i = 0; i < 24; i += apart) {
            Camera camera;
            const double turn = 2.0 * std::numbers::pi * i / 24.0;
            // Some cameras are near enough that the near plane cuts the surface.
            const double away = i % 3 == 0 ? 16.9 : 9.0 * std::sin(7.0 * turn);
            camera.eye = away * glm::normalize(glm::dvec3(std::cos(turn), std::sin(3.0 * turn),
                                                          std::sin(turn)));
            camera.target = camera.eye + glm::dvec3(std::sin(5.0 * turn), std::cos(3.0 * turn),
                                                    std::cos(5.0 * turn));
            picture.draw(raster, camera, settings, 1.0);
            const Pixels pixels = picture.pixels();
            int brightest = 0;
            for (std::size_t p = 0; p < pixels.size(); ++p)
                brightest = std::max(brightest, p % 4 == 3 ? 0 : valueAt(pixels, p));
            // A single leaking sample of four would give 128 or more.
            EXPECT_LT(brightest, 90) << samples << " samples, camera " << i;
        }
    }
}

TEST_F(OpaqueTest, NobodySeesThroughAClosedSurface)
{
    expectClosed(5);
}

TEST_F(LongOpaqueTest, NobodySeesThroughAClosedSurface)
{
    expectClosed(1);
}

} // namespace
} // namespace sward::render
