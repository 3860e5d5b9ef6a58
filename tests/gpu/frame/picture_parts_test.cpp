// A picture that is drawn in parts is the picture that is drawn at once.

#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace sward::render {
namespace {

using PictureParts = test::GpuTest;

constexpr glm::uvec2 whole(160, 90);
constexpr glm::uvec2 part(64, 48);
constexpr std::size_t bytesOfPixel = 4;

// The picture, put together from parts; the last of each row and column reach beyond it.
std::vector<std::byte> inParts(const gpu::DeviceContext& context, FieldRenderer& renderer,
                               const Camera& camera, const FrameSettings& settings, double time)
{
    std::vector<std::byte> all(bytesOfPixel * whole.x * whole.y);
    test::Picture picture(context, part);
    for (glm::uvec2 first(0); first.y < whole.y; first.y += part.y)
        for (first.x = 0; first.x < whole.x; first.x += part.x) {
            picture.drawPart(renderer, camera, settings, time, whole, glm::ivec2(first));
            const std::vector<std::byte> pixels = picture.pixels();
            const glm::uvec2 size = glm::min(part, whole - first);
            for (std::size_t row = 0; row < size.y; ++row)
                std::copy_n(&pixels[bytesOfPixel * row * part.x], bytesOfPixel * size.x,
                            &all[bytesOfPixel * ((first.y + row) * whole.x + first.x)]);
        }
    return all;
}

TEST_F(PictureParts, MakeTheWholePicture)
{
    const field::Field field = test::makeField({.blades = 6000, .extent = 8.0f});
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    FieldRenderer renderer(device(), field::viewOf(field), {.samples = 1});
    Camera camera;
    camera.eye = {0.0, 1.5, 9.0};
    test::Picture picture(context(), whole);
    picture.draw(renderer, camera, settings, 1.0);
    const std::vector<std::byte> expected = picture.pixels();
    const std::vector<std::byte> found = inParts(context(), renderer, camera, settings, 1.0);

    // Rounding of the other matrix moves edges by less than a hundredth of a pixel, and light by
    // less than what is seen.
    constexpr int seen = 4;
    std::size_t different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (std::abs(std::to_integer<int>(expected[i]) - std::to_integer<int>(found[i])) > seen)
            ++different;
    EXPECT_LT(different, expected.size() / 1000);
    // The picture shows grass: its pixels differ from one another.
    EXPECT_GT(test::largestDifference(expected, std::vector<std::byte>(expected.size())), 100);
}

} // namespace
} // namespace sward::render
