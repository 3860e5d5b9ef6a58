// The exposure that is chosen for a field shows meadows of any colour as middle grey, over any
// ground, and clips nothing bright.

#include "core/math/srgb.h"
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

constexpr glm::uvec2 size(128, 72);
constexpr float side = 14.0f; ///< [m] of the flat fields

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
        field::Field field = test::makeField({.blades = 120'000, .extent = side});
        field.species[0].look.rootColor = root;
        field.species[0].look.tipColor = tip;
        field.ground.materials[0].baseColor = glm::vec4(ground, ground, ground, 1.0f);
        return field;
    }

    static field::Field bare(float ground)
    {
        field::Field field = test::emptyField();
        field.ground = test::planeGround(side);
        field.ground.materials[0].baseColor = glm::vec4(ground, ground, ground, 1.0f);
        return field;
    }

    /// The field from a person's height, with the sun beside.
    Light lightOf(const field::Field& field, std::optional<float> exposure = {})
    {
        FieldRenderer renderer(device(), field::viewOf(field), {});
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.exposure = exposure;
        Camera camera;
        camera.eye = {4.0, 1.7, 4.0};
        camera.target = {0.0, -0.9, 0.0};
        camera.fovY = 30.0f;
        test::Picture picture(context(), size);
        picture.draw(renderer, camera, settings, 0.0);
        const std::vector<std::byte> pixels = picture.pixels();
        Light light;
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            const auto channel = [&](std::size_t c) { return std::to_integer<int>(pixels[i + c]); };
            const auto linear = [&](std::size_t c) {
                return double(linearOf(float(channel(c)) / 255.0f));
            };
            light.mean += 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
            light.clipped += std::max({channel(0), channel(1), channel(2)}) == 255 ? 1.0 : 0.0;
        }
        const double count = double(pixels.size()) / 4.0;
        light.mean /= count;
        light.clipped /= count;
        return light;
    }
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

TEST_F(ExposureTest, WhatSettingsStateIsUsed)
{
    const field::Field field = bare(0.2f);
    const float chosen = chosenExposure(field::viewOf(field));
    EXPECT_NE(chosen, 1.0f);
    EXPECT_EQ(chosen, chosenExposure(field::viewOf(field)));
    EXPECT_DOUBLE_EQ(lightOf(field).mean, lightOf(field, chosen).mean);
    EXPECT_LT(lightOf(field, 0.5f * chosen).mean, lightOf(field).mean);
    // A host's view has no field to choose by.
    EXPECT_EQ(frameOf({}, {}, {}, 0.0, 1).exposure, 1.0f);
}

} // namespace
} // namespace sward::render
