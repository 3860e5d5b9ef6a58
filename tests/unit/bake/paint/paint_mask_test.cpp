#include "bake/mask/sample_places.h"
#include "bake/paint/painting.h"
#include "bake/plan/paint_mask.h"
#include "bake/sample/triangle_points.h"
#include "core/error.h"
#include "support/meshes.h"
#include "terrain/image/channel_image.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sward::bake {
namespace {

using testing::HasSubstr;
using tests::hardStroke;

constexpr double side = 20.0;       // [m] of the ground
constexpr std::uint32_t size = 256; // [texels]
constexpr double inset = 0.05;      // [images] around the ground
constexpr double texel = side / (1.0 - 2.0 * inset) / size;

// Coordinates seen from above, off the image's edge.
terrain::GroundMesh mapped(terrain::GroundMesh ground)
{
    const Aabb box = ground.bounds();
    for (std::size_t v = 0; v < ground.positions.size(); ++v) {
        const glm::vec3 share = (ground.positions[v] - box.low) / float(side);
        ground.uvs[v] =
            glm::vec2(float(inset)) + float(1.0 - 2.0 * inset) * glm::vec2(share.x, share.z);
    }
    return ground;
}

// Soft strokes that do not meet.
Strokes softStrokes()
{
    Strokes strokes;
    strokes.list = {hardStroke(StrokeKind::erase, {{-5.0, 0.0, -5.0}, {-5.0, 0.0, 5.0}}, 3.0),
                    hardStroke(StrokeKind::set, {{4.0, 0.0, -5.0}}, 4.0, 0.4),
                    hardStroke(StrokeKind::erase, {{9.0, 0.0, 6.0}}, 4.0)};
    for (Stroke& stroke : strokes.list) {
        stroke.hardness = 0.25;
        stroke.depth = 50.0;
    }
    return strokes;
}

struct Painted {
    PaintMask mask;
    std::vector<std::string> warnings;
};

Painted painted(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads = 2)
{
    Diagnostics diagnostics;
    Progress progress;
    Painted result{paintMask(ground, settings, size, threads, diagnostics, progress), {}};
    result.warnings = diagnostics.warnings();
    return result;
}

std::string errorOf(const terrain::GroundMesh& ground)
{
    try {
        painted(ground, tests::plainSettings(1.0));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

// Largest difference between the image, read as a mask, and the density of the strokes, at places
// at least `border` [m] off the ground's edge.
double largestError(const terrain::GroundMesh& ground, double border)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.strokes = softStrokes();
    const PaintMask mask = painted(ground, settings).mask;
    terrain::ChannelImage image{size, size, {}};
    for (const std::uint8_t value : mask.values)
        image.values.push_back(static_cast<std::uint16_t>(257 * value));
    const Painting painting(settings.strokes, ground.origin, ground.bounds());
    double largest = 0.0;
    forEachPlace(ground, 50'000, [&](const RootSample& place) {
        const RootSample root =
            TrianglePoints(ground, place.triangle).at(place.barycentric.x, place.barycentric.y, 0);
        if (std::max(std::fabs(root.position.x), std::fabs(root.position.z)) > side / 2 - border)
            return true;
        const glm::uvec3 corners = ground.triangles[root.triangle];
        const glm::vec2 b = root.barycentric;
        const glm::vec2 uv = (1.0f - b.x - b.y) * ground.uvs[corners.x] +
                             b.x * ground.uvs[corners.y] + b.y * ground.uvs[corners.z];
        largest = std::max(largest, std::fabs(terrain::valueAt(image, glm::dvec2(uv)) -
                                              painting.densityAt(root.position, root.normal, 1.0)));
        return true;
    });
    return largest;
}

// As docs/painting.md says: rounding, and bilinear reading over the width of the soft edge.
TEST(PaintMask, ReadAsAMaskIsTheDensityOfTheStrokes)
{
    constexpr double rounding = 0.5 / 255.0;
    constexpr double soft = 2.25; // [m] the least soft edge: 3 m · (1 − 0.25)
    const terrain::GroundMesh plane = mapped(meshes::grid(50, side));
    EXPECT_LT(largestError(plane, 2.0 * texel), rounding + 3.0 * std::pow(texel / soft, 2));
    EXPECT_LT(largestError(plane, 0.0), rounding + 1.5 * texel / soft);
    // Texels of a slope are longer on it.
    const terrain::GroundMesh hills = mapped(meshes::hills(side, 50));
    EXPECT_LT(largestError(hills, 0.0), rounding + 1.5 * 1.5 * texel / soft);
}

TEST(PaintMask, MultipliesMasks)
{
    terrain::GroundMesh ground = mapped(meshes::grid(4, side));
    ground.hasColors = true;
    std::fill(ground.colors.begin(), ground.colors.end(), glm::vec4(0.5f));
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {Mask(), Mask()};
    settings.slope = {80.0, 90.0, 0.0}; // a filter, which is no mask
    settings.strokes.list = {hardStroke(StrokeKind::erase, {{5.0, 0.0, 5.0}}, 2.0)};
    const PaintMask mask = painted(ground, settings).mask;
    EXPECT_EQ(mask.values[size / 2 * size + size / 2], 64);
    EXPECT_EQ(std::count(mask.values.begin(), mask.values.end(), 64) +
                  std::count(mask.values.begin(), mask.values.end(), 0),
              std::ptrdiff_t(size) * size);
}

TEST(PaintMask, ClipsDensitiesAboveOneAndWarns)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.strokes.list = {hardStroke(StrokeKind::set, {{0.0, 0.0, 0.0}}, 5.0, 3.0)};
    const auto [mask, warnings] = painted(mapped(meshes::grid(4, side)), settings);
    const double disk = 3.14159 * 25.0 / (texel * texel);
    EXPECT_NEAR(double(mask.clipped), disk, 0.02 * disk);
    EXPECT_EQ(mask.values[size / 2 * size + size / 2], 255);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("above 1 on 19."));
}

TEST(PaintMask, GoesTwoTexelsBeyondTheGroundAndNoFarther)
{
    const PaintMask mask = painted(mapped(meshes::grid(4, side)), tests::plainSettings(1.0)).mask;
    const double edge = inset * size - 0.5; // of the ground, in texels
    for (std::uint32_t column = 0; column < size / 2; ++column)
        EXPECT_EQ(mask.values[size / 2 * size + column], double(column) >= edge - 2.0 ? 255 : 0)
            << column;
    EXPECT_NEAR(double(mask.covered), std::pow((1.0 - 2.0 * inset) * size, 2), 2.0 * size);
}

TEST(PaintMask, IsReadRoundTheImagesEdge)
{
    terrain::GroundMesh ground = mapped(meshes::grid(8, side));
    BakeSettings settings = tests::plainSettings(1.0);
    settings.strokes = softStrokes();
    const PaintMask before = painted(ground, settings).mask;
    for (glm::vec2& uv : ground.uvs)
        uv += glm::vec2(3.5f, -1.25f);
    const PaintMask after = painted(ground, settings).mask;
    std::size_t other = 0;
    for (std::uint32_t row = 0; row < size; ++row)
        for (std::uint32_t column = 0; column < size; ++column)
            other +=
                before.values[row * size + column] !=
                        after
                            .values[(row + size * 3 / 4) % size * size + (column + size / 2) % size]
                    ? 1U
                    : 0U;
    // Single precision moves a few texels by a step.
    EXPECT_LT(other, size);
    EXPECT_EQ(after.overlapping, 0U);
}

TEST(PaintMask, WarnsOfCoordinatesThatOverlap)
{
    terrain::GroundMesh ground = mapped(meshes::grid(30, side));
    const BakeSettings settings = tests::plainSettings(1.0);
    EXPECT_EQ(painted(ground, settings).mask.overlapping, 0U);
    EXPECT_TRUE(painted(ground, settings).warnings.empty());
    append(ground, meshes::moved(ground, {0.0, 5.0, 0.0}));
    const auto [mask, warnings] = painted(ground, settings);
    EXPECT_NEAR(double(mask.overlapping), double(mask.covered), 0.02 * double(mask.covered));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("overlap"));
}

TEST(PaintMask, NeedsCoordinatesThatDoNotRepeatOnATriangle)
{
    terrain::GroundMesh ground = mapped(meshes::grid(2, side));
    EXPECT_EQ(errorOf(ground), "");
    for (glm::vec2& uv : ground.uvs)
        uv *= 3.0f;
    EXPECT_THAT(errorOf(ground), HasSubstr("1.35 x 1.35 images, at most 1"));
    std::fill(ground.uvs.begin(), ground.uvs.end(), glm::vec2(0.0f));
    EXPECT_THAT(errorOf(ground), HasSubstr("no texture coordinates"));
}

TEST(PaintMask, HasTheSameBytesForAnyNumberOfThreads)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.strokes = tests::allKinds();
    const terrain::GroundMesh ground = mapped(meshes::hills(side, 40));
    EXPECT_EQ(painted(ground, settings, 1).mask.values, painted(ground, settings, 3).mask.values);
}

} // namespace
} // namespace sward::bake
