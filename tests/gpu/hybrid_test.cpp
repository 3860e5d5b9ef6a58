// Large blades by the tessellator, the others by compute shaders: one picture.

#include "core/error.h"
#include "picture.h"
#include "render/geometry_trial.h"
#include "render/large_blade_pass.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace sward::render {
namespace {

constexpr glm::uvec2 size{320, 192};
constexpr std::uint32_t tile = 32;

using Pixels = std::vector<std::byte>;

double valueAt(const Pixels& pixels, std::size_t i)
{
    return std::to_integer<int>(pixels[i]);
}

/// PSNR [dB] over the pixels in which either differs from the picture without grass.
double psnr(const Pixels& a, const Pixels& b, const Pixels& bare)
{
    double error = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        if (std::equal(&a[i], &a[i] + 4, &bare[i]) && std::equal(&b[i], &b[i] + 4, &bare[i]))
            continue;
        for (std::size_t c = 0; c < 3; ++c)
            error += std::pow(valueAt(a, i + c) - valueAt(b, i + c), 2.0);
        count += 3;
    }
    EXPECT_GT(count, a.size() / 10) << "there is grass to compare";
    return 10.0 * std::log10(255.0 * 255.0 * double(count) / std::max(error, 1e-9));
}

/// The largest mean signed difference of any tile, of 255.
double worstTile(const Pixels& a, const Pixels& b)
{
    double worst = 0.0;
    for (std::uint32_t row = 0; row + tile <= size.y; row += tile)
        for (std::uint32_t column = 0; column + tile <= size.x; column += tile) {
            double sum = 0.0;
            for (std::uint32_t y = row; y < row + tile; ++y)
                for (std::uint32_t x = column; x < column + tile; ++x)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const std::size_t i = 4 * (std::size_t(y) * size.x + x) + c;
                        sum += valueAt(a, i) - valueAt(b, i);
                    }
            worst = std::max(worst, std::fabs(sum) / (3.0 * tile * tile));
        }
    return worst;
}

class HybridTest : public test::GpuTest {
protected:
    static FieldRenderer rendererOf(const field::Field& field, Geometry geometry,
                                    std::uint32_t samples, bool forCpu = false)
    {
        return FieldRenderer(device(), field::viewOf(field),
                             {.samples = samples, .geometry = geometry, .rastersForCpu = forCpu});
    }
};

TEST_F(HybridTest, ItsPictureIsThatOfEitherWayAlone)
{
    const field::Field field = test::thicket();
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer hybrid = rendererOf(field, Geometry::hybrid, samples);
        FieldRenderer raster = rendererOf(field, Geometry::raster, samples);
        FieldRenderer forCpu = rendererOf(field, Geometry::raster, samples, true);
        FieldRenderer tessellation = rendererOf(field, Geometry::tessellation, samples);
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        test::Picture picture(context(), size);
        const auto draw = [&](FieldRenderer& renderer, int step) {
            picture.draw(renderer, test::onTheWay(step), settings, 1.0);
            return picture.pixels();
        };
        for (const int step : {0, 2, 5}) {
            const Pixels both = draw(hybrid, step);
            const std::uint64_t drawn = hybrid.stats().drawn;
            const Pixels byCompute = draw(raster, step);
            const Pixels byPipeline = draw(tessellation, step);
            EXPECT_GT(drawn, 100u);
            settings.nature.drawDistance = 1e-3f;
            const Pixels bare = draw(raster, step);
            settings = FrameSettings::of(field::viewOf(field));
            // Here and there a sample lies so near to an edge that the two do not agree: in less
            // than 1 of 300 pixels. With one sample such a pixel shows another blade altogether.
            EXPECT_LT(test::differingPixels(both, byCompute), size.x * size.y / 300)
                << samples << " samples, step " << step;
            EXPECT_GE(psnr(both, byCompute, bare), samples > 1 ? 45.0 : 37.0)
                << samples << " samples, step " << step;
            EXPECT_LE(worstTile(both, byCompute), 1.0) << samples << " samples, step " << step;
            EXPECT_LE(worstTile(both, byPipeline), 2.0) << samples << " samples, step " << step;
            // By a thread each, large blades are the same but for what single samples keep.
            EXPECT_LE(worstTile(draw(forCpu, step), byPipeline), 2.0)
                << samples << " samples, step " << step;
            // Which samples large blades cover is then the pipeline's affair in both.
            EXPECT_GE(psnr(both, byPipeline, bare), psnr(byCompute, byPipeline, bare))
                << samples << " samples, step " << step;
            // What it has of the pipeline: edges, here and there a last bit.
            EXPECT_GT(test::differingPixels(both, byCompute), 0u) << "step " << step;
        }
    }
}

TEST_F(HybridTest, WithoutLargeBladesEachByteIsTheRasterisers)
{
    const field::Field field = test::makeField({.blades = 4000, .extent = 8.0f});
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer hybrid = rendererOf(field, Geometry::hybrid, samples);
        FieldRenderer raster = rendererOf(field, Geometry::raster, samples);
        const FrameSettings settings = FrameSettings::of(field::viewOf(field));
        Camera camera;
        camera.eye = {0.0, 6.0, 18.0};
        test::Picture one(context(), size);
        test::Picture other(context(), size);
        one.draw(hybrid, camera, settings, 1.0);
        other.draw(raster, camera, settings, 1.0);
        EXPECT_GT(hybrid.stats().drawn, 1000u);
        EXPECT_EQ(test::differingPixels(one.pixels(), other.pixels()), 0u) << samples;
    }
}

TEST_F(HybridTest, AGpuMeasuresBothWaysAndKeepsTheFaster)
{
    // A CPU that says it is a GPU.
    gpu::DeviceContext pretended = context();
    pretended.type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    const field::Field field = test::thicket();
    const field::FieldView view = field::viewOf(field);
    FieldRenderer trying(pretended, view, {.samples = 1});
    FieldRenderer raster(context(), view, {.samples = 1, .geometry = Geometry::raster});
    const FrameSettings settings = FrameSettings::of(view);
    test::Picture picture(context(), {160, 96});
    test::Picture expected(context(), {160, 96});
    expected.draw(raster, test::onTheWay(0), settings, 1.0);
    std::size_t byTessellator = 0;
    std::size_t frames = 0;
    for (; frames < 4 * GeometryTrial::framesEach; ++frames) {
        picture.draw(trying, test::onTheWay(0), settings, 1.0);
        ASSERT_TRUE(rasterises(trying.geometry()));
        // Of 15 360 pixels a few lie at edges where the two do not agree.
        EXPECT_LT(test::differingPixels(picture.pixels(), expected.pixels()), 150u);
        if (std::string(trying.geometryReason()).starts_with("measured"))
            break;
        byTessellator += trying.geometry() == Geometry::hybrid ? 1u : 0u;
    }
    // The first frame that knows of all measurements decides.
    EXPECT_EQ(frames, 2 * GeometryTrial::framesEach);
    EXPECT_EQ(byTessellator, GeometryTrial::framesEach);
    double compute = 0.0;
    double tessellator = 0.0;
    ASSERT_EQ(std::sscanf(trying.geometryReason(),
                          "measured: blades take %lf ms by compute shaders, %lf ms", &compute,
                          &tessellator),
              2);
    EXPECT_GT(compute, 0.0);
    EXPECT_GT(tessellator, 0.0);
    if (tessellator < 0.9 * compute) {
        EXPECT_EQ(trying.geometry(), Geometry::hybrid);
    }
    if (tessellator > compute) {
        EXPECT_EQ(trying.geometry(), Geometry::raster);
    }

    // Nothing is measured where there is nothing to choose.
    pretended.features.sampleShading = false;
    const FieldRenderer plain(pretended, view, {.samples = 4});
    EXPECT_EQ(plain.geometry(), Geometry::raster);
    EXPECT_EQ(std::string(plain.geometryReason()).find("measured"), std::string::npos);
}

TEST_F(HybridTest, SaysWhatADeviceLacks)
{
    gpu::DeviceContext lacking = context();
    EXPECT_EQ(obstacleToLargeBlades(lacking, 4), nullptr);
    lacking.features.sampleShading = false;
    EXPECT_EQ(obstacleToLargeBlades(lacking, 1), nullptr);
    EXPECT_NE(obstacleToLargeBlades(lacking, 4), nullptr);
    lacking.features.fragmentStores = false;
    const field::Field field = test::makeField({.blades = 10, .extent = 2.0f});
    try {
        FieldRenderer(lacking, field::viewOf(field), {.geometry = Geometry::hybrid});
        FAIL() << "it cannot be drawn";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_NE(std::string(error.what()).find("fragmentStoresAndAtomics"), std::string::npos);
    }
}

} // namespace
} // namespace sward::render
