// After Grass::prepare() no frame of the kinds it was told of makes a pipeline.

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/command_pool.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "shadow_map.h"
#include "store_canvas.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> hostTestShaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

using test::HostPicture;
using test::StoreCanvas;

/// Pipelines that were made by a context of counting().
std::atomic<int> made = 0;
PFN_vkCreateComputePipelines createCompute = nullptr;
PFN_vkCreateGraphicsPipelines createGraphics = nullptr;

/// Compiled in place of every compute shader: frames are recorded, and not run.
VkShaderModule nothing = VK_NULL_HANDLE;

VKAPI_ATTR VkResult VKAPI_CALL countCompute(VkDevice device, VkPipelineCache cache,
                                            std::uint32_t count,
                                            const VkComputePipelineCreateInfo* infos,
                                            const VkAllocationCallbacks* allocation,
                                            VkPipeline* pipelines)
{
    made += static_cast<int>(count);
    std::vector<VkComputePipelineCreateInfo> empty(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : empty) {
        info.stage.module = nothing;
        info.stage.pSpecializationInfo = nullptr;
    }
    return createCompute(device, cache, count, empty.data(), allocation, pipelines);
}

VKAPI_ATTR VkResult VKAPI_CALL countGraphics(VkDevice device, VkPipelineCache cache,
                                             std::uint32_t count,
                                             const VkGraphicsPipelineCreateInfo* infos,
                                             const VkAllocationCallbacks* allocation,
                                             VkPipeline* pipelines)
{
    made += static_cast<int>(count);
    return createGraphics(device, cache, count, infos, allocation, pipelines);
}

/// A host's context, which shares nothing and counts the pipelines that are made.
gpu::DeviceContext counting(const gpu::DeviceContext& context)
{
    gpu::DeviceContext host = context;
    host.shared = nullptr;
    createCompute = std::exchange(host.vk.CreateComputePipelines, countCompute);
    createGraphics = std::exchange(host.vk.CreateGraphicsPipelines, countGraphics);
    return host;
}

class GrassPrepareTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        nothing = nothing_.get();
        if (!context().features.bufferInt64Atomics)
            GTEST_SKIP() << "the device has no 64-bit atomics";
    }

    /// Grass of a host, with so many instances of the field. Large blades are drawn as on a CPU, or
    /// as on a GPU: in two passes, if there is one instance.
    std::unique_ptr<Grass> grassOf(int instances, Grass::Settings settings = {})
    {
        settings.framesInFlight = 1;
        settings.keepsMotion = true;
        auto grass = std::make_unique<Grass>(host_, settings);
        for (int i = 0; i < instances; ++i)
            grass->add({resident(), {.position = {double(i), 0.0, 0.0}, .scale = 0.9}});
        return grass;
    }

    const std::shared_ptr<ResidentField>& resident()
    {
        if (!resident_)
            resident_ = upload(field_);
        return resident_;
    }

    /// How many pipelines a frame makes. It is recorded, but the device does not run it.
    int madeBy(Grass& grass, const GrassFrame& frame) const
    {
        const int before = made;
        grass.begin(0, frame);
        const VkCommandBuffer commands = pool_.allocate("frame");
        gpu::begin(commands);
        grass.recordUpdate(commands);
        for (std::uint32_t view = 0; view < frame.views.size(); ++view) {
            grass.recordCull(commands, view);
            grass.recordRaster(commands, view);
        }
        EXPECT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
        return made - before;
    }

    const gpu::ShaderModule nothing_ =
        gpu::ShaderLibrary(embedded::hostTestShaders()).module(context(), "nothing.comp");
    const gpu::DeviceContext host_ = counting(context());
    const gpu::CommandPool pool_{context()};
    std::shared_ptr<ResidentField> resident_;
};

enum class Stored { no, halves, bytes };
enum class Light { none, ambient, lamps, shadow };

/// A frame by what its pipelines depend on.
struct PreparedKind {
    std::uint32_t samples;
    bool isReversed;
    bool hasDepth;
    Stored stored;
    Light light;
    int instances;
    std::size_t views;
    std::vector<WindSource> winds;
    Geometry geometry = Geometry::raster;
};

/// What frames of a kind show.
struct Shown {
    const HostPicture& ofOneSample;
    const HostPicture& ofFour;
    const StoreCanvas& halves;
    const StoreCanvas& bytes;
    HostShadow shadow;
};

HostView viewOf(const PreparedKind& kind, const Shown& shown)
{
    HostView view = test::lookingFrom({0.0, 2.0, 4.0}, kind.isReversed);
    view.samples = kind.samples;
    view.geometry = kind.geometry;
    if (kind.hasDepth)
        view.depth = (kind.samples == 1 ? shown.ofOneSample : shown.ofFour).depth();
    if (kind.stored != Stored::no)
        view.stored = (kind.stored == Stored::halves ? shown.halves : shown.bytes).picture();
    if (kind.light == Light::shadow)
        view.shadow = shown.shadow;
    return view;
}

TEST_F(GrassPrepareTest, LeavesNoPipelineToFrames)
{
    const HostPicture ofOneSample(context(), {});
    const HostPicture ofFour(context(), {.samples = 4});
    const StoreCanvas halves(context(), {.format = VK_FORMAT_R16G16B16A16_SFLOAT});
    const StoreCanvas bytes(context(), {});
    const test::ShadowMap map(context(), 8, 1, [](std::uint32_t, glm::uvec2) { return 0.0f; });
    const glm::dmat4 toShadow[]{test::worldToShadow({0.5, 1.0, 0.2}, 4.0, true)};
    const Shown shown{
        ofOneSample, ofFour, halves, bytes, {.view = map.view(), .worldToShadow = toShadow}};
    const HostLamp lamps[]{{.position = {0.5, 1.5, 0.5}}};
    const HostCollider colliders[]{{.radius = 0.3}};
    const std::vector<WindSource> breeze = settings_.winds;
    std::vector<WindSource> gusts{windSource(windGusts), windSource(windTurning)};
    for (WindSource& wind : gusts)
        wind.source.strength = 1.0f;

    const PreparedKind kinds[]{
        {1, true, true, Stored::no, Light::none, 1, 1, breeze},
        {1, false, true, Stored::bytes, Light::lamps, 1, 1, breeze},
        {4, true, false, Stored::halves, Light::shadow, 1, 1, gusts},
        {4, false, true, Stored::no, Light::lamps, 3, 1, {}},
        {1, true, false, Stored::halves, Light::shadow, 3, 2, breeze},
        {4, true, true, Stored::bytes, Light::ambient, 1, 2, gusts},
        {1, false, true, Stored::no, Light::none, 1, 1, gusts, Geometry::tessellation}};
    for (const bool isCpu : {true, false})
        for (const PreparedKind& kind : kinds) {
            SCOPED_TRACE(testing::Message()
                         << "kind " << &kind - kinds << ", as on a " << (isCpu ? "CPU" : "GPU"));
            const std::vector<HostView> views(kind.views, viewOf(kind, shown));
            settings_.winds = kind.winds;
            GrassFrame frame{.time = 1.0, .views = views, .settings = settings_};
            frame.colliders = colliders;
            if (kind.light == Light::lamps)
                frame.light.lamps = lamps;
            if (kind.light == Light::ambient)
                frame.light.ambient = HostAmbient::constant(glm::vec3(0.5f));

            const auto grass = grassOf(kind.instances, {.rastersForCpu = isCpu});
            const ResidentField* const fields[]{resident().get()};
            const int before = made;
            grass->prepare(
                frame,
                {.fields = fields, .one = kind.instances == 1, .several = kind.instances > 1});
            EXPECT_GE(made - before, kind.geometry == Geometry::raster ? 5 : 2);
            frame.colliders = {};
            EXPECT_EQ(madeBy(*grass, frame), 0) << "before there are colliders";
            frame.colliders = colliders;
            EXPECT_EQ(madeBy(*grass, frame), 0);
            frame.colliders = {};
            EXPECT_EQ(madeBy(*grass, frame), 0) << "after there were colliders";
        }
}

TEST_F(GrassPrepareTest, FramesThatAreNotPreparedMakePipelines)
{
    HostView view = test::lookingFrom({0.0, 2.0, 4.0});
    view.geometry = Geometry::raster;
    const GrassFrame frame{.views = {&view, 1}, .settings = settings_};
    EXPECT_GT(madeBy(*grassOf(1), frame), 0);

    // Of what prepare() was not told of, a frame makes the rest.
    const auto grass = grassOf(1);
    const ResidentField* const fields[]{resident().get()};
    grass->prepare(frame, {.fields = fields, .one = false});
    EXPECT_GT(madeBy(*grass, frame), 0);
}

TEST_F(GrassPrepareTest, AFrameWithoutInstancesMakesNoPipeline)
{
    HostView view = test::lookingFrom({0.0, 2.0, 4.0});
    view.geometry = Geometry::raster;
    EXPECT_EQ(madeBy(*grassOf(0), {.views = {&view, 1}, .settings = settings_}), 0);
}

TEST_F(GrassPrepareTest, PreparesListsWithoutRoomForAllBlades)
{
    HostView view = test::lookingFrom({0.0, 2.0, 4.0});
    view.geometry = Geometry::raster;
    const GrassFrame frame{.views = {&view, 1}, .settings = settings_};
    for (const std::uint32_t maxListed : {100u, 1'000'000u}) {
        const auto grass = grassOf(1, {.maxListed = maxListed, .rastersForCpu = false});
        const ResidentField* const fields[]{resident().get()};
        grass->prepare(frame, {.fields = fields, .several = false});
        EXPECT_EQ(madeBy(*grass, frame), 0) << maxListed;
    }
}

TEST_F(GrassPrepareTest, RefusesFieldsThatAreNone)
{
    const auto grass = grassOf(1);
    const GrassFrame frame{.settings = settings_};
    const ResidentField* const fields[]{nullptr};
    EXPECT_THROW(grass->prepare(frame, {}), Error);
    EXPECT_THROW(grass->prepare(frame, {.fields = fields}), Error);
}

TEST_F(GrassPrepareTest, PreparesFieldsThatAreStreamed)
{
    const field::Field large = test::makeField({.blades = 60'000, .extent = 32.0f, .seed = 5});
    const ResidentField whole(host_, field::viewOf(large));
    const auto lawn = std::make_shared<ResidentField>(
        host_, std::make_shared<const field::Field>(large),
        FieldBudget{.bytes = whole.deviceBytes(), .keepsMotion = true, .framesInFlight = 1});
    ASSERT_TRUE(lawn->isStreamed());
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    HostView view = test::lookingFrom({0.0, 2.0, 4.0});
    view.geometry = Geometry::raster;
    const GrassFrame frame{.views = {&view, 1}, .settings = settings_};
    const ResidentField* const fields[]{lawn.get()};
    for (const bool isCpu : {true, false}) {
        Grass grass(host_, {.framesInFlight = 1, .keepsMotion = true, .rastersForCpu = isCpu});
        grass.add({lawn, {}});
        grass.prepare(frame, {.fields = fields, .several = false});
        EXPECT_EQ(madeBy(grass, frame), 0);
    }
}

TEST_F(GrassPrepareTest, IsCalledByOtherThreadsBesideFrames)
{
    const auto grass = grassOf(1, {.rastersForCpu = false});
    const ResidentField* const fields[]{resident().get()};
    HostView view = test::lookingFrom({0.0, 2.0, 4.0});
    view.geometry = Geometry::raster;
    HostView other = view;
    other.samples = 4;
    const GrassFrame frame{.views = {&view, 1}, .settings = settings_};
    const GrassFrame next{.time = 0.1, .views = {&other, 1}, .settings = settings_};
    {
        const std::jthread first([&] { grass->prepare(next, {.fields = fields}); });
        const std::jthread second([&] { grass->prepare(next, {.fields = fields}); });
        for (int i = 0; i < 3; ++i)
            madeBy(*grass, frame);
    }
    EXPECT_EQ(madeBy(*grass, next), 0);
}

} // namespace
} // namespace sward::render
