// The ways of drawing: graphics pipeline, rasteriser of a GPU, rasteriser of a CPU; one and four
// samples a pixel. All show the same picture. Other tests draw by one way, unless they are about
// the difference of two.

#include "bake/bake.h"
#include "bake/settings/meadow.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "likeness.h"
#include "picture.h"
#include "presentation/camera_presets.h"
#include "support/gpu/gpu_fixture.h"
#include "terrain/load.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace sward::render {
namespace {

using presentation::CameraPreset;
using presentation::presetCamera;

struct Scene {
    std::string name;
    std::string ground; ///< what terrain::load() knows, or a file of assets/meshes
    std::uint64_t blades = 0;
    double bladeScale = 1.0;
    CameraPreset camera = CameraPreset::fit;
    std::string shape{}; ///< of a meadow of one species; empty: the meadow "grass"
    float fold = 0.0f;
    std::vector<std::uint32_t> samples{1, 4};
    bool levelOfDetail = true;
    int tessellationLevel = 0;
    glm::uvec2 size{224, 128}; ///< [pixels]
};

void PrintTo(const Scene& scene, std::ostream* out)
{
    *out << scene.name;
}

/// So wide that a fold shows.
std::string meadowOf(const std::string& shape, float fold)
{
    return R"({"species": [{"name": "one", "shape": ")" + shape + R"(", "fold": )" +
           std::to_string(fold) + R"(, "width_m": [0.08, 0.16], "height_m": [0.6, 1.2]}]})";
}

std::vector<Scene> scenes()
{
    return {
        {.name = "hillsFromFar",
         .ground = "hills",
         .blades = 16000,
         .bladeScale = 3.0,
         .size = {320, 192}},
        {.name = "hillsFromAmidTheBlades",
         .ground = "hills",
         .blades = 20000,
         .bladeScale = 3.0,
         .camera = CameraPreset::eye},
        {.name = "sphere", .ground = "sphere", .blades = 4000, .bladeScale = 4.0},
        {.name = "landscape",
         .ground = SWARD_MESHES "/landscape.glb",
         .blades = 20000,
         .bladeScale = 6.0,
         .size = {320, 192}}, // from its `eye`, lavapipe tessellates no blade, unlike an H200
        {.name = "withoutLevelOfDetail",
         .ground = "dunes",
         .blades = 10000,
         .camera = CameraPreset::edge,
         .samples = {4},
         .levelOfDetail = false},
        {.name = "atAFixedLevel",
         .ground = "dunes",
         .blades = 10000,
         .camera = CameraPreset::edge,
         .samples = {1},
         .tessellationLevel = 7},
    };
}

/// A shape has code of its own, flat or folded, so that its pipelines take three seconds here: the
/// default suite has three of them, the long one all.
std::vector<Scene> shapes()
{
    std::vector<Scene> all;
    std::uint32_t samples = 4;
    for (const char* const shape : {"triangle-tip", "quad", "triangle", "quadratic", "dandelion"})
        for (const float fold : {0.0f, 1.0f}) {
            std::string name = shape;
            std::erase(name, '-');
            all.push_back({.name = name + (fold > 0.0f ? "Folded" : "Flat"),
                           .ground = "plane",
                           .blades = 1000,
                           .camera = CameraPreset::edge,
                           .shape = shape,
                           .fold = fold,
                           .samples = {fold > 0.0f ? samples = 5 - samples : 4},
                           .size = {160, 96}});
        }
    return all;
}

field::Field baked(const Scene& scene)
{
    Diagnostics diagnostics;
    Progress progress;
    bake::BakeSettings settings;
    settings.count = scene.blades;
    settings.bladeScale = scene.bladeScale;
    settings.exposureRays = 0;
    settings.meadow = scene.shape.empty()
                          ? bake::loadMeadow("grass")
                          : bake::parseMeadow(meadowOf(scene.shape, scene.fold), scene.name);
    return bake::bakeField(terrain::load(scene.ground, {}, diagnostics), settings, 2, diagnostics,
                           progress)
        .field;
}

class WaysTest : public test::GpuTest {
protected:
    static FieldRenderer rendererOf(const field::FieldView& field, Geometry geometry,
                                    std::uint32_t samples, bool forCpu)
    {
        return {
            device(), field, {.samples = samples, .geometry = geometry, .rastersForCpu = forCpu}};
    }
};

class WaysOfDrawing : public WaysTest, public testing::WithParamInterface<Scene> {};

TEST_P(WaysOfDrawing, ShowTheSame)
{
    const Scene& scene = GetParam();
    const field::Field field = baked(scene);
    const field::FieldView view = field::viewOf(field);
    FrameSettings settings = FrameSettings::of(view);
    settings.levelOfDetail = scene.levelOfDetail;
    settings.tessellationLevel = scene.tessellationLevel;
    FrameSettings none = settings;
    none.environment.drawDistance = 1e-3f;
    const Camera camera = presetCamera(scene.camera, view, {0.0f, 1.0f, 0.0f},
                                       float(scene.size.x) / float(scene.size.y));
    test::Picture picture(context(), scene.size);
    for (const std::uint32_t samples : scene.samples) {
        FieldRenderer pipeline = rendererOf(view, Geometry::tessellation, samples, false);
        picture.draw(pipeline, camera, none, 1.0);
        const auto bare = picture.pixels();
        picture.draw(pipeline, camera, settings, 1.0);
        const auto expected = picture.pixels();
        for (const bool forCpu : {false, true}) {
            SCOPED_TRACE(testing::Message() << samples << " samples, for CPU: " << forCpu);
            FieldRenderer raster = rendererOf(view, Geometry::raster, samples, forCpu);
            picture.draw(raster, camera, settings, 1.0);
            const test::Likeness alike =
                test::likeness(picture.pixels(), expected, bare, scene.size);
            EXPECT_GT(alike.grass, 0.02) << "there is grass to compare";
            EXPECT_GE(alike.psnr,
                      scene.fold > 0.0f && samples > 1 ? test::minPsnrOfFolds : test::minPsnr);
            EXPECT_LE(alike.worstTile, test::maxTileDifference);
        }
    }
}

TEST_F(WaysTest, ShowTheSameReasons)
{
    // Level of detail leaves many blades out, and widens others: all are drawn as wide as they are.
    const Scene scene{.name = "reasons", .ground = "hills", .blades = 20000, .bladeScale = 3.0};
    const field::Field field = baked(scene);
    const field::FieldView view = field::viewOf(field);
    FrameSettings settings = FrameSettings::of(view);
    settings.lodThreshold = 4.0f;
    settings.debug = DebugMode::reason;
    FrameSettings none = settings;
    none.debug = DebugMode::none;
    none.environment.drawDistance = 1e-3f;
    const Camera camera = presetCamera(CameraPreset::fit, view, {0.0f, 1.0f, 0.0f},
                                       float(scene.size.x) / float(scene.size.y));
    test::Picture picture(context(), scene.size);
    std::vector<std::byte> bare;
    std::vector<std::byte> expected;
    for (const Geometry geometry : {Geometry::tessellation, Geometry::raster}) {
        FieldRenderer renderer(device(), view,
                               {.samples = 1,
                                .geometry = geometry,
                                .rastersForCpu = false,
                                .recordCullResults = true});
        if (geometry == Geometry::tessellation) {
            picture.draw(renderer, camera, none, 1.0);
            bare = picture.pixels();
        }
        picture.draw(renderer, camera, settings, 1.0);
        EXPECT_GT(renderer.stats().lod, 1000u);
        if (geometry == Geometry::tessellation)
            expected = picture.pixels();
    }
    const test::Likeness alike = test::likeness(picture.pixels(), expected, bare, scene.size);
    EXPECT_GT(alike.grass, 0.02);
    EXPECT_GE(alike.psnr, test::minPsnr);
    EXPECT_LE(alike.worstTile, test::maxTileDifference);
}

std::string nameOf(const testing::TestParamInfo<Scene>& scene)
{
    return scene.param.name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, WaysOfDrawing, testing::ValuesIn(scenes()), nameOf);
INSTANTIATE_TEST_SUITE_P(Shapes, WaysOfDrawing,
                         testing::Values(shapes()[1], shapes()[2], shapes()[9]), nameOf);
INSTANTIATE_TEST_SUITE_P(LongShapes, WaysOfDrawing, testing::ValuesIn(shapes()), nameOf);

using OrderOfThreads = WaysTest;

/// Whichever thread comes first: blades of equal depth are told apart by their ids.
TEST_F(OrderOfThreads, ChangesNoByteOfAPicture)
{
    const field::Field field = baked(scenes()[1]);
    const field::FieldView view = field::viewOf(field);
    const FrameSettings settings = FrameSettings::of(view);
    const Camera camera = presetCamera(CameraPreset::eye, view, {0.0f, 1.0f, 0.0f}, 1.75f);
    test::Picture picture(context(), scenes()[1].size);
    for (const bool forCpu : {false, true}) {
        std::vector<std::byte> first;
        for (int i = 0; i < 4; ++i) {
            FieldRenderer renderer = rendererOf(view, Geometry::raster, 4, forCpu);
            picture.draw(renderer, camera, settings, 1.0);
            if (first.empty())
                first = picture.pixels();
            EXPECT_EQ(test::differingPixels(first, picture.pixels()), 0u);
        }
    }
}

} // namespace
} // namespace sward::render
