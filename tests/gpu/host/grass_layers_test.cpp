// Layers of a host's view: what its picture shows, as numbers.

#include "core/error.h"
#include "gpu/frame/picture.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "render/layers/frame_layers.h"
#include "shaders/shared/layers/layers_table.h"
#include "store_canvas.h"

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace sward::render {
namespace {

using test::hostSize;
using test::lookingFrom;

constexpr std::size_t pixelCount = std::size_t(hostSize.x) * hostSize.y;
constexpr LayerMask hostLayers = allLayers & ~bitOf(Layer::flowForward);

class GrassLayersTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        if (!context().features.bufferInt64Atomics)
            GTEST_SKIP() << "the device has no 64-bit atomics";
        settings_.winds.clear();
        resident_ = upload(field_);
    }

    HostView viewFrom(glm::dvec3 eye, std::uint32_t samples = 1)
    {
        HostView view = lookingFrom(eye);
        view.geometry = Geometry::raster;
        view.samples = samples;
        return view;
    }

    /// Stores a frame of one view and writes its layers. Of several samples they are counted in
    /// the composite's place, which is not drawn.
    FrameLayers draw(Grass& grass, double time, HostView view, const test::StoreCanvas* canvas,
                     LayerMask wanted = hostLayers) const
    {
        const std::size_t bytes = layerBytes(wanted, view.size, true);
        const gpu::Buffer words(context(), {.name = "host's layers",
                                            .bytes = bytes,
                                            .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
        view.layers = HostLayers{.wanted = wanted, .words = words.address()};
        if (canvas != nullptr)
            view.stored = canvas->picture();
        grass.begin(0, {.time = time, .views = {&view, 1}, .settings = settings_});
        gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
            grass.recordUpdate(commands);
            if (canvas != nullptr)
                canvas->recordScene(commands);
            grass.recordCull(commands, 0);
            grass.recordRaster(commands, 0);
            if (canvas != nullptr)
                canvas->recordEnd(commands);
        });
        const auto read = gpu::readBufferAs<std::uint32_t>(context(), words);
        const field::FieldView seen = field::viewOf(field_);
        const std::vector<LayerInstance> instances(grass.layerInstances().size(), {.field = &seen});
        return layersOf({.size = view.size, .wanted = wanted, .words = read}, instances);
    }

    std::shared_ptr<ResidentField> resident_;
};

/// The place of the world that a pixel shows at a depth along the ray.
glm::dvec3 placeAt(const HostView& view, std::size_t pixel, double depth)
{
    const glm::dmat4 toWorld = glm::inverse(view.worldToClip);
    const glm::dvec2 middle(double(pixel % hostSize.x) + 0.5, double(pixel / hostSize.x) + 0.5);
    const glm::dvec2 place = 2.0 * middle / glm::dvec2(hostSize) - 1.0;
    glm::dvec4 far = toWorld * glm::dvec4(place, 0.5, 1.0);
    far /= far.w;
    const glm::dvec3 eye = eyeOf(view.worldToClip);
    return eye + depth * glm::normalize(glm::dvec3(far) - eye);
}

TEST_F(GrassLayersTest, ShowWhatIsStoredAndWhereItStands)
{
    Grass grass(context(), {.framesInFlight = 1, .keepsMotion = true});
    const Placement second{.position = {0.5, 0.2, -0.4},
                           .rotation = glm::angleAxis(0.8, glm::normalize(glm::dvec3(0.2, 1, 0.1))),
                           .scale = 1.3};
    grass.add({resident_, {}});
    grass.add({resident_, second});
    ASSERT_EQ(grass.layerInstances().size(), 0u) << "before the first frame";
    const HostView view = viewFrom({2.0, 2.5, 4.0});
    const test::StoreCanvas canvas(context(), {});
    const FrameLayers layers = draw(grass, 1.0, view, &canvas);
    const std::vector<float> stored = canvas.depths();

    const field::FieldView field = field::viewOf(field_);
    std::set<std::uint64_t> known;
    for (std::size_t i = 0; i < field.blades.size(); ++i)
        for (std::uint32_t instance = 0; instance < 2; ++instance)
            known.insert(LayerId::of(field.idOf(i), instance));
    const auto kinds = layers.as<std::uint8_t>(Layer::kind);
    const auto ids = layers.as<std::uint64_t>(Layer::blade);
    const auto depths = layers.as<float>(Layer::depth);
    const auto planes = layers.as<float>(Layer::planarDepth);
    const auto normals = layers.as<std::uint16_t>(Layer::normal);
    const auto flows = layers.as<glm::vec2>(Layer::flowBackward);
    const auto coverage = layers.as<std::uint16_t>(Layer::coverage);
    std::size_t ofInstance[2] = {};
    for (std::size_t i = 0; i < pixelCount; ++i) {
        const bool isGrass = stored[i] != test::StoreCanvas::depthBefore;
        ASSERT_EQ(kinds[i] == shared::kindBlade, isGrass) << i;
        ASSERT_EQ(ids[i] != 0, isGrass) << i;
        EXPECT_EQ(glm::unpackHalf1x16(coverage[i]), isGrass ? 1.0f : 0.0f);
        if (!isGrass) {
            EXPECT_TRUE(std::isinf(depths[i]));
            EXPECT_TRUE(std::isnan(flows[i].x));
            continue;
        }
        ASSERT_TRUE(known.contains(ids[i])) << i;
        ++ofInstance[(ids[i] >> LayerId::bladeBits) - 1];
        // The depth that is stored, as metres in the world.
        const glm::dvec3 place = placeAt(view, i, double(depths[i]));
        const glm::dvec4 clip = view.worldToClip * glm::dvec4(place, 1.0);
        EXPECT_NEAR(clip.w, double(planes[i]), 1e-3);
        EXPECT_NEAR(0.1 / clip.w, 0.1 / planes[i], 1e-4);
        EXPECT_NEAR(clip.z / clip.w, double(stored[i]), 1e-5);
        // The visible side.
        const glm::dvec3 normal(glm::unpackHalf1x16(normals[3 * i]),
                                glm::unpackHalf1x16(normals[3 * i + 1]),
                                glm::unpackHalf1x16(normals[3 * i + 2]));
        EXPECT_NEAR(glm::length(normal), 1.0, 2e-3);
        EXPECT_LT(glm::length(flows[i]), 1e-3f) << "nothing has moved";
    }
    EXPECT_GT(ofInstance[0], pixelCount / 50);
    EXPECT_GT(ofInstance[1], pixelCount / 50);
    EXPECT_EQ(grass.layerInstances().size(), 2u);
}

TEST_F(GrassLayersTest, AreThoseOfTheViewer)
{
    // The viewer's ground lies below all roots, and hides none.
    settings_.maxLeafArea = 0.0f;
    settings_.levelOfDetail = false;
    settings_.bladeShadows = false;
    Grass grass(context(), oneSlot_);
    grass.add({resident_, {}});
    Camera camera;
    camera.eye = {1.5, 1.8, 3.0};
    camera.target = glm::dvec3(0.0);
    camera.fovY = 2.0f * glm::degrees(std::atan(0.5f));
    FieldRenderer::Settings wanted;
    wanted.samples = 1;
    wanted.geometry = Geometry::raster;
    FieldRenderer viewer(device(), field::viewOf(field_), wanted);
    test::Picture picture(context(), hostSize);
    constexpr LayerMask compared = bitOf(Layer::blade) | bitOf(Layer::plant) | bitOf(Layer::depth) |
                                   bitOf(Layer::albedo) | bitOf(Layer::species) |
                                   bitOf(Layer::patch);
    picture.drawLayers(viewer, camera, settings_, 1.0, compared);
    const FrameLayers expected =
        layersOf(viewer.layerWords(field::viewOf(field_)), field::viewOf(field_));
    const FrameLayers layers = draw(grass, 1.0, viewFrom(camera.eye), nullptr, compared);
    const auto ids = layers.as<std::uint64_t>(Layer::blade);
    const auto plants = layers.as<std::uint64_t>(Layer::plant);
    const auto viewers = expected.as<std::uint64_t>(Layer::blade);
    const auto albedos = layers.as<std::uint16_t>(Layer::albedo);
    const auto viewersAlbedos = expected.as<std::uint16_t>(Layer::albedo);
    std::size_t all = 0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < pixelCount; ++i) {
        if (viewers[i] == 0)
            continue;
        ++all;
        if (ids[i] != viewers[i])
            continue;
        ++same;
        EXPECT_EQ(plants[i], expected.as<std::uint64_t>(Layer::plant)[i]);
        EXPECT_EQ(layers.as<std::uint8_t>(Layer::species)[i],
                  expected.as<std::uint8_t>(Layer::species)[i]);
        EXPECT_EQ(layers.as<std::uint32_t>(Layer::patch)[i],
                  expected.as<std::uint32_t>(Layer::patch)[i]);
        EXPECT_NEAR(layers.as<float>(Layer::depth)[i], expected.as<float>(Layer::depth)[i], 1e-3f);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(glm::unpackHalf1x16(albedos[3 * i + c]),
                        glm::unpackHalf1x16(viewersAlbedos[3 * i + c]), 2e-2f);
    }
    EXPECT_GT(all, pixelCount / 10);
    EXPECT_GE(double(same), 0.995 * double(all));
}

TEST_F(GrassLayersTest, CountAllFourSamples)
{
    Grass grass(context(), oneSlot_);
    grass.add({resident_, {}});
    constexpr LayerMask wanted = bitOf(Layer::coverage) | bitOf(Layer::blade);
    const FrameLayers layers = draw(grass, 1.0, viewFrom({2.0, 2.5, 4.0}, 4), nullptr, wanted);
    const auto ids = layers.as<std::uint64_t>(Layer::blade);
    std::size_t between = 0;
    for (std::size_t i = 0; i < pixelCount; ++i) {
        const float share = glm::unpackHalf1x16(layers.as<std::uint16_t>(Layer::coverage)[i]);
        EXPECT_EQ(ids[i] != 0, share > 0.0f);
        between += share > 0.0f && share < 1.0f ? 1u : 0u;
    }
    EXPECT_GT(between, pixelCount / 50);
}

TEST_F(GrassLayersTest, AreRefusedWhereTheyCannotBeWritten)
{
    Grass grass(context(), oneSlot_);
    grass.add({resident_, {}});
    HostView view = viewFrom({2.0, 2.5, 4.0});
    const auto begins = [&](HostLayers layers) {
        view.layers = layers;
        grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings_});
    };
    EXPECT_THROW(begins({.wanted = bitOf(Layer::flowForward), .words = 64}), Error);
    EXPECT_THROW(begins({.wanted = bitOf(Layer::flowBackward), .words = 64}), Error)
        << "no motion is kept";
    EXPECT_THROW(begins({.wanted = bitOf(Layer::depth), .words = 0}), Error);
    EXPECT_THROW(begins({.wanted = bitOf(Layer::depth), .words = 72}), Error);
    EXPECT_THROW(begins({.wanted = 1u << 30, .words = 64}), Error);
    begins({});
}

} // namespace
} // namespace sward::render
