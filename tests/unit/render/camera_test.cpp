#include "core/random.h"
#include "presentation/camera_presets.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "shaders/shared/culling.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

using presentation::CameraPreset;
using presentation::presetCamera;

constexpr std::uint64_t cameraSeed = 8;
constexpr glm::uvec2 cameraSize(160, 90);
const Aabb box{glm::vec3(-5.0f), glm::vec3(5.0f)};

Camera slanted()
{
    Camera camera;
    camera.eye = {4.0, 7.0, 9.0};
    camera.target = {-1.0, 0.5, 0.3};
    camera.up = {0.2f, 1.0f, -0.1f};
    camera.near = 0.5f;
    camera.far = 40.0f;
    return camera;
}

glm::vec3 randomPoint(std::uint64_t i, double reach)
{
    const auto at = [&](std::uint32_t d) {
        return reach * (2.0 * uniform(cameraSeed, i, d) - 1.0);
    };
    return glm::vec3(glm::dvec3(at(0), at(1), at(2)));
}

TEST(Camera, PlanesEncloseWhatTheProjectionShows)
{
    const ViewMatrices view = viewMatrices(slanted(), {}, cameraSize, box);
    int inside = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const glm::vec3 point = randomPoint(i, 20.0);
        float closest = 1e9f;
        for (const glm::vec4& plane : view.planes)
            closest = std::min(closest, shared::planeDistance(plane, point));
        if (std::abs(closest) < 1e-4f)
            continue;
        const glm::vec4 clip = view.viewProjection * glm::vec4(point, 1.0f);
        const bool shown = std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w &&
                           clip.z >= 0.0f && clip.z <= clip.w;
        ASSERT_EQ(shown, closest > 0.0f) << "point " << i << ", seed " << cameraSeed;
        inside += shown ? 1 : 0;
    }
    EXPECT_GT(inside, 500);
}

TEST(Camera, APartShowsEachPointWhereTheWholeDoes)
{
    constexpr glm::ivec2 first(-9, 37);
    constexpr glm::uvec2 part(48, 64);
    const ViewMatrices whole = viewMatrices(slanted(), {}, cameraSize, box);
    const ViewMatrices view = partOf(whole, cameraSize, first, part);
    EXPECT_EQ(view.pixelsPerUnit, whole.pixelsPerUnit);
    const auto pixelOf = [](const ViewMatrices& of, glm::uvec2 extent, glm::vec3 point) {
        const glm::vec4 clip = of.viewProjection * glm::vec4(point, 1.0f);
        return (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(extent);
    };
    int inside = 0;
    for (std::uint64_t i = 0; i < 60'000; ++i) {
        const glm::vec3 point = randomPoint(i, 5.0);
        const glm::vec4 clip = whole.viewProjection * glm::vec4(point, 1.0f);
        const glm::vec2 place = pixelOf(whole, cameraSize, point) - glm::vec2(first);
        ASSERT_LT(glm::distance(pixelOf(view, part, point), place), 2e-3f) << "point " << i;
        float closest = 1e9f;
        for (const glm::vec4& plane : view.planes)
            closest = std::min(closest, shared::planeDistance(plane, point));
        if (std::abs(closest) < 1e-3f)
            continue;
        const bool shown = place.x >= 0.0f && place.y >= 0.0f && place.x <= float(part.x) &&
                           place.y <= float(part.y) && clip.z >= 0.0f && clip.z <= clip.w;
        ASSERT_EQ(shown, closest > 0.0f) << "point " << i << ", seed " << cameraSeed;
        inside += shown ? 1 : 0;
    }
    EXPECT_GT(inside, 500);
}

/// A point of the picture lies on its pixel's ray, at a distance given by w, so depth determines
/// its position. Shaders that shade the rasteriser's result use this.
TEST(Camera, RaysMeetWhatIsSeen)
{
    const ViewMatrices view = viewMatrices(slanted(), {}, cameraSize, box);
    shared::Frame frame = {};
    look(frame, view);
    const glm::vec3 depthRow(view.viewProjection[0].z, view.viewProjection[1].z,
                             view.viewProjection[2].z);
    int seen = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const glm::vec3 point = randomPoint(i, 20.0);
        const glm::vec4 clip = view.viewProjection * glm::vec4(point, 1.0f);
        if (clip.w < 0.5f || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w)
            continue;
        const glm::vec2 place = glm::vec2(clip) / clip.w;
        const glm::vec3 ray = place.x * frame.rays[0] + place.y * frame.rays[1] + frame.rays[2];
        EXPECT_LT(glm::length(view.eye + clip.w * ray - point), 1e-4f * clip.w) << "point " << i;
        const float along = frame.depthOfEye / (clip.z / clip.w - glm::dot(depthRow, ray));
        EXPECT_NEAR(along, clip.w, 1e-3f * clip.w) << "point " << i;
        ++seen;
    }
    EXPECT_GT(seen, 500);
}

TEST(Camera, OfParallelRaysThereAreNone)
{
    glm::mat4 parallel(1.0f);
    parallel[2].z = -0.01f;
    shared::Frame frame = {};
    project(frame, parallel, glm::vec3(0.0f, 0.0f, 5.0f));
    for (const glm::vec3& ray : frame.rays)
        EXPECT_EQ(ray, glm::vec3(0.0f));
}

/// The air thins upwards from the lowest visible point, and its density stays finite.
TEST(Camera, StandsInAirThatThinsUpwards)
{
    const FieldShape field{.content = box, .blade = {}};
    FrameSettings settings;
    settings.fogDensity = 0.03f;
    const auto densityAt = [&](float height) {
        Camera camera = slanted();
        camera.eye = {4.0, double(box.low.y) + double(height), 9.0};
        return frameOf(field, viewMatrices(camera, {}, cameraSize, box), settings, 0.0, 1)
            .fogDensity;
    };
    EXPECT_FLOAT_EQ(densityAt(0.0f), 0.03f);
    EXPECT_FLOAT_EQ(densityAt(50.0f), 0.03f);
    settings.fogHeight = 4.0f;
    EXPECT_NEAR(densityAt(0.0f), 0.03f, 1e-6f);
    EXPECT_NEAR(densityAt(4.0f), 0.03f / std::exp(1.0f), 1e-6f);
    EXPECT_NEAR(densityAt(12.0f) / densityAt(8.0f), 1.0f / std::exp(1.0f), 1e-4f);
    EXPECT_TRUE(std::isfinite(densityAt(-1e6f)));
    settings.fogDensity = 0.0f;
    EXPECT_EQ(densityAt(-1e6f), 0.0f);
}

TEST(Camera, DepthFallsFromOneAtNearToZeroAtFar)
{
    const Camera camera = slanted();
    const ViewMatrices view = viewMatrices(camera, {}, cameraSize, box);
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const auto depth = [&](double distance) {
        const glm::vec4 clip =
            view.viewProjection * glm::vec4(glm::vec3(camera.eye + distance * forward), 1.0f);
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(0.5), 1.0f, 1e-4f);
    EXPECT_NEAR(depth(40.0), 0.0f, 1e-5f);
    EXPECT_GT(depth(3.0), depth(3.01));
}

TEST(Camera, UpIsUpInThePictureAndRightIsRight)
{
    Camera camera;
    camera.eye = {0.0, 0.0, 10.0};
    const ViewMatrices view = viewMatrices(camera, {}, cameraSize, box);
    const glm::vec4 above = view.viewProjection * glm::vec4(0.0f, 1.0f, 0.0f, 1.0f);
    const glm::vec4 right = view.viewProjection * glm::vec4(1.0f, 0.0f, 0.0f, 1.0f);
    EXPECT_LT(above.y, 0.0f);
    EXPECT_GT(right.x, 0.0f);
    // One metre at ten metres is a tenth of pixelsPerUnit.
    EXPECT_NEAR(-above.y / above.w * 0.5f * 90.0f, 0.1f * view.pixelsPerUnit, 1e-3f);
}

TEST(Camera, SeesTheSameFromFarOutAsAtTheOrigin)
{
    const glm::dvec3 far(1048576.0, -524288.0, 2097152.0);
    Camera camera = slanted();
    const ViewMatrices here = viewMatrices(camera, {}, cameraSize, box);
    camera.eye += far;
    camera.target += far;
    const ViewMatrices there = viewMatrices(camera, far, cameraSize, box);
    for (glm::length_t column = 0; column < 4; ++column)
        EXPECT_LT(glm::length(here.viewProjection[column] - there.viewProjection[column]), 1e-5f);
}

TEST(Camera, LooksStraightDownWithoutLosingItsAxes)
{
    Camera camera;
    camera.eye = {0.0, 10.0, 0.0};
    camera.target = {0.0, 0.0, 0.0};
    const ViewMatrices view = viewMatrices(camera, {}, cameraSize, box);
    const glm::vec4 clip = view.viewProjection * glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    EXPECT_NEAR(clip.x, 0.0f, 1e-5f);
    EXPECT_NEAR(clip.w, 10.0f, 1e-4f);
}

/// Largest |x| or |y| of the field's roots and tips, in half pictures; 0 is the centre.
float reachOf(const field::Field& field, const Camera& camera, glm::uvec2 picture)
{
    const field::FieldView view = field::viewOf(field);
    const ViewMatrices matrices = viewMatrices(camera, field.origin, picture, view.bounds());
    float reach = 0.0f;
    for (const shared::Patch& cell : field.patches) {
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[cell.firstBlade + i], cell);
            for (const float height : {0.0f, blade.height}) {
                const glm::vec4 clip =
                    matrices.viewProjection * glm::vec4(blade.root + height * blade.up, 1.0f);
                EXPECT_GT(clip.z, 0.0f);
                EXPECT_LT(clip.z, clip.w);
                reach = std::max({reach, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
            }
        }
    }
    return reach;
}

TEST(Camera, PresetsShowAllOfAFieldAndFillThePicture)
{
    for (const test::Surface surface : {test::Surface::plane, test::Surface::sphere}) {
        const field::Field field = test::makeField(
            {.surface = surface, .blades = 3000, .extent = 6.0f, .origin = {1e6, 50.0, -2e6}});
        for (const glm::uvec2 picture : {glm::uvec2(160, 90), glm::uvec2(90, 160)}) {
            const float aspect = static_cast<float>(picture.x) / static_cast<float>(picture.y);
            for (const CameraPreset preset : {CameraPreset::fit, CameraPreset::top}) {
                const Camera camera =
                    presetCamera(preset, field::viewOf(field), glm::vec3(0.0f, 1.0f, 0.0f), aspect);
                const float reach = reachOf(field, camera, picture);
                EXPECT_LE(reach, 0.9f);
                EXPECT_GE(reach, 0.8f);
            }
        }
    }
}

TEST(Camera, StandsAboveTheGroundWhereThePresetPutsIt)
{
    const field::Field field = test::makeField({.extent = 20.0f, .origin = {0.0, 300.0, 0.0}});
    const field::FieldView view = field::viewOf(field);
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    EXPECT_NEAR(presetCamera(CameraPreset::eye, view, up, 1.5f).eye.y, 301.7, 1e-4);
    EXPECT_NEAR(presetCamera(CameraPreset::edge, view, up, 1.5f).eye.y, 303.0, 1e-4);
}

/// Number of blades that the preset `eye` shows of a lawn `extent` [m] long whose ground is not
/// displayed. Above its centre, at eight metres, there is a small ground to stand on.
int shownFromAbove(float extent)
{
    field::Field field = test::makeField(
        {.surface = test::Surface::plane, .blades = 3000, .extent = extent, .hasGround = false});
    for (const glm::vec2 corner :
         {glm::vec2(-0.5f, -0.5f), glm::vec2(0.5f, -0.5f), glm::vec2(0.0f, 0.5f)}) {
        shared::GroundVertex vertex = {};
        vertex.position = {corner.x, 8.0f, corner.y};
        field.ground.indices.push_back(static_cast<std::uint32_t>(field.ground.vertices.size()));
        field.ground.vertices.push_back(vertex);
    }
    const std::size_t count = field.ground.indices.size();
    field.ground.ranges.push_back(
        {.firstIndex = static_cast<std::uint32_t>(count - 3), .indexCount = 3});
    const field::FieldView view = field::viewOf(field);
    const Camera camera =
        presetCamera(CameraPreset::eye, view, glm::vec3(0.0f, 1.0f, 0.0f), 16.0f / 9.0f);
    EXPECT_GT(camera.eye.y, 8.0);
    const ViewMatrices matrices = viewMatrices(camera, field.origin, cameraSize, view.bounds());
    int shown = 0;
    for (const shared::Patch& cell : field.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const glm::vec3 root =
                shared::unpackBlade(field.blades[cell.firstBlade + i], cell).root;
            const glm::vec4 clip = matrices.viewProjection * glm::vec4(root, 1.0f);
            shown +=
                clip.w > 0.0f && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w ? 1 : 0;
        }
    return shown;
}

TEST(Camera, LooksAtTheFieldFromOnTopOfAnArch)
{
    EXPECT_GT(shownFromAbove(6.0f), 100);
    // The far end of this lawn would be in the picture's lowest rows.
    EXPECT_GT(shownFromAbove(37.0f), 100);
    // On a lawn, the view is nearly horizontal: there is sky above the grass.
    const field::Field lawn = test::makeField({.surface = test::Surface::plane, .extent = 40.0f});
    const Camera ahead = presetCamera(CameraPreset::eye, field::viewOf(lawn),
                                      glm::vec3(0.0f, 1.0f, 0.0f), 16.0f / 9.0f);
    const glm::dvec3 way = glm::normalize(ahead.target - ahead.eye);
    EXPECT_NEAR(way.y, -0.15, 0.05);
}

TEST(Camera, HasAPlaceEvenForAnEmptyField)
{
    const field::Field field = test::emptyField();
    for (const CameraPreset preset :
         {CameraPreset::fit, CameraPreset::eye, CameraPreset::top, CameraPreset::edge}) {
        const Camera camera =
            presetCamera(preset, field::viewOf(field), glm::vec3(0.0f, 1.0f, 0.0f), 1.5f);
        EXPECT_GT(glm::length(camera.target - camera.eye), 0.0);
        EXPECT_TRUE(std::isfinite(glm::length(camera.eye)));
    }
}

} // namespace
} // namespace sward::render
