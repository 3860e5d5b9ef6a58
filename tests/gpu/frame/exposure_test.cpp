// The exposure that is chosen for a field shows meadows of any colour as middle grey, over any
// ground, and clips nothing bright.

#include "core/math/srgb.h"
#include "field/measure/leaf_area.h"
#include "picture.h"
#include "render/frame/frame.h"
#include "render/viewer/exposure.h"
#include "support/fields/display_ground.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 exposureSize(128, 72);
constexpr float exposureSide = 14.0f; ///< [m] of the flat fields

/// What a picture without sky shows.
struct Light {
    double mean = 0.0;    ///< linear luminance (ITU-R BT.709)
    double clipped = 0.0; ///< share of the pixels with a channel at its end
};

class ExposureTest : public test::GpuTest {
protected:
    /// A closed sward with these linear colours of roots and tips over a ground of one colour.
    static field::Field meadow(glm::vec3 root, glm::vec3 tip, float ground)
    {
        field::Field field = test::makeField({.blades = 120'000, .extent = exposureSide});
        field.species[0].look.rootColor = root;
        field.species[0].look.tipColor = tip;
        field.ground.materials[0].baseColor = glm::vec4(ground, ground, ground, 1.0f);
        return field;
    }

    static field::Field bare(float ground)
    {
        field::Field field = test::emptyField();
        field.ground = test::planeGround(exposureSide);
        field.ground.materials[0].baseColor = glm::vec4(ground, ground, ground, 1.0f);
        return field;
    }

    static float exposureOf(const field::Field& field)
    {
        const field::FieldView view = field::viewOf(field);
        return chosenExposure(view, field::leafAreaOf(view));
    }

    /// A meadow in the middle of a square of ground that is `wider` times as long.
    static field::Field clearing(float ground, float wider)
    {
        field::Field field = meadow({0.03f, 0.06f, 0.015f}, {0.12f, 0.26f, 0.045f}, ground);
        const shared::GroundMaterial material = field.ground.materials[0];
        field.ground = test::planeGround(wider * exposureSide);
        field.ground.materials[0] = material;
        return field;
    }

    /// The field from a person's height, with the sun beside.
    /// `end`: the least value that counts as clipped.
    Light lightOf(const field::Field& field, std::optional<float> exposure = {},
                  glm::dvec3 eye = {4.0, 1.7, 4.0}, int end = 255)
    {
        FieldRenderer renderer(device(), field::viewOf(field), {});
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.exposure = exposure;
        if (sunAbove_)
            settings.sunDirection = {0.0f, 1.0f, 0.0f};
        Camera camera;
        camera.eye = eye;
        camera.target = eye - glm::dvec3(4.0, 2.6, 4.0);
        camera.fovY = 30.0f;
        test::Picture picture(context(), exposureSize);
        picture.draw(renderer, camera, settings, 0.0);
        const std::vector<std::byte> pixels = picture.pixels();
        Light light;
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            const auto channel = [&](std::size_t c) { return std::to_integer<int>(pixels[i + c]); };
            const auto linear = [&](std::size_t c) {
                return double(linearOf(float(channel(c)) / 255.0f));
            };
            light.mean += 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
            light.clipped += std::max({channel(0), channel(1), channel(2)}) >= end ? 1.0 : 0.0;
        }
        const double count = double(pixels.size()) / 4.0;
        light.mean /= count;
        light.clipped /= count;
        return light;
    }

    bool sunAbove_ = false; ///< the sun stands in the zenith
};

TEST_F(ExposureTest, MeadowsOfAnyColourAreMiddleGreyOnAnyGround)
{
    const glm::vec3 green[] = {{0.03f, 0.06f, 0.015f}, {0.12f, 0.26f, 0.045f}};
    for (const float darkness : {0.5f, 1.0f, 1.6f})
        for (const float ground : {0.02f, 0.9f}) {
            const Light light = lightOf(meadow(darkness * green[0], darkness * green[1], ground));
            EXPECT_NEAR(light.mean, 0.18, 0.05) << darkness << " on " << ground;
            EXPECT_LE(light.clipped, 0.01) << darkness << " on " << ground;
        }
    const Light straw = lightOf(meadow({0.06f, 0.055f, 0.02f}, {0.3f, 0.24f, 0.1f}, 0.1f));
    EXPECT_NEAR(straw.mean, 0.18, 0.05);
}

TEST_F(ExposureTest, BareGroundIsNeitherDarkNorClipped)
{
    for (const float ground : {0.02f, 0.06f, 0.2f, 0.5f, 1.0f}) {
        const Light light = lightOf(bare(ground));
        EXPECT_GT(light.mean, 0.1) << ground;
        EXPECT_LE(light.clipped, 0.01) << ground;
    }
    // Darker ground stays darker where both are beyond the range of exposures.
    EXPECT_LT(lightOf(bare(0.2f)).mean, lightOf(bare(1.0f)).mean);
}

TEST_F(ExposureTest, BrightGroundBesideAMeadowCountsByItsArea)
{
    const float closed = exposureOf(clearing(0.06f, 1.0f));
    // Earth and dark rock leave the meadow as it is.
    for (const float ground : {0.02f, 0.06f})
        EXPECT_NEAR(exposureOf(clearing(ground, 2.0f)) / closed, 1.0f, 0.02f) << ground;
    // The more bright ground is seen, the lower is the exposure, but never to the black of leaves.
    float before = closed;
    for (const float wider : {1.2f, 1.6f, 2.2f, 3.0f}) {
        const float now = exposureOf(clearing(0.8f, wider));
        EXPECT_LT(now, before) << wider;
        EXPECT_GT(now, 0.3f * closed) << wider;
        before = now;
    }
    // Snow and chalk are bright and do not clip, even if they face the sun: no channel is above
    // 245.
    sunAbove_ = true;
    const field::Field snow = clearing(0.85f, 2.0f);
    const glm::dvec3 beside(11.5, 1.7, 11.5);
    const Light seen = lightOf(snow, {}, beside, 245);
    EXPECT_EQ(seen.clipped, 0.0);
    EXPECT_GT(seen.mean, 0.5);
    // By the meadow alone all of it did.
    EXPECT_GT(lightOf(snow, closed, beside, 245).clipped, 0.4);
}

TEST_F(ExposureTest, FewBladesDoNotDecide)
{
    // Sand is brighter than middle grey, and a few blades on it change little.
    const field::Field sand = bare(0.4f);
    const Light seen = lightOf(sand);
    EXPECT_GT(seen.mean, 0.25);
    EXPECT_LT(seen.mean, 0.6);
    field::Field few = test::makeField({.blades = 20, .extent = exposureSide});
    few.ground.materials[0].baseColor = sand.ground.materials[0].baseColor;
    EXPECT_NEAR(exposureOf(few) / exposureOf(sand), 1.0f, 0.1f);
}

TEST_F(ExposureTest, ColoursOfVerticesAndImagesCount)
{
    field::Field white = clearing(1.0f, 2.0f);
    const float bright = exposureOf(white);
    for (shared::GroundVertex& corner : white.ground.vertices)
        corner.color = 0xff101010u;
    EXPECT_GT(exposureOf(white), 1.2f * bright);
    // One black texel of four on two triangles is a quarter of the ground.
    field::Field image = clearing(1.0f, 2.0f);
    image.ground.images.push_back(
        {.width = 2, .height = 2, .rgba = std::vector<std::uint8_t>(16, 255)});
    image.ground.materials[0].image = 0;
    EXPECT_NEAR(exposureOf(image), bright, 1e-4f);
    std::fill_n(image.ground.images[0].rgba.begin(), 3, std::uint8_t(0));
    EXPECT_GT(exposureOf(image), 1.05f * bright);
    EXPECT_LT(exposureOf(image), exposureOf(white));
}

TEST_F(ExposureTest, WhatSettingsStateIsUsed)
{
    const field::Field field = bare(0.2f);
    const float chosen = exposureOf(field);
    EXPECT_NE(chosen, 1.0f);
    EXPECT_EQ(chosen, exposureOf(field));
    EXPECT_DOUBLE_EQ(lightOf(field).mean, lightOf(field, chosen).mean);
    EXPECT_LT(lightOf(field, 0.5f * chosen).mean, lightOf(field).mean);
    // A host's view has no field to choose by.
    EXPECT_EQ(frameOf({}, {}, {}, 0.0, 1).exposure, 1.0f);
}

} // namespace
} // namespace sward::render
