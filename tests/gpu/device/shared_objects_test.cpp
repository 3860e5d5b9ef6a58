// Objects of a device that are made once.

#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shared_objects.h"
#include "gpu/pipeline/uniform_sets.h"
#include "support/gpu/gpu_fixture.h"
#include "test_shaders.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

namespace sward::gpu {
namespace {

using SharedObjectsTest = test::GpuTest;

ComputePipelineSettings square()
{
    return {.name = "square", .shader = "square.comp", .pushConstantBytes = 24};
}

GraphicsPipelineSettings corner()
{
    GraphicsPipelineSettings settings;
    settings.name = "corner";
    settings.vertexShader = "corner.vert";
    settings.fragmentShader = "plain.frag";
    settings.pushConstantBytes = 24;
    settings.colorFormats = {VK_FORMAT_R8G8B8A8_UNORM};
    return settings;
}

TEST_F(SharedObjectsTest, EqualPipelinesAreOne)
{
    const ShaderLibrary shaders = test::testShaders();
    VkPipeline first = VK_NULL_HANDLE;
    {
        const ComputePipeline pipeline(context(), shaders, square());
        first = pipeline.get();
    }
    // Its name does not matter, and it outlives its user.
    ComputePipelineSettings renamed = square();
    renamed.name = "another";
    EXPECT_EQ(ComputePipeline(context(), shaders, renamed).get(), first);
    EXPECT_EQ(GraphicsPipeline(context(), shaders, corner()).get(),
              GraphicsPipeline(context(), shaders, corner()).get());
    EXPECT_EQ(UniformSetLayout(context(), "a").get(), UniformSetLayout(context(), "b").get());

    // A host's device shares nothing.
    DeviceContext host = context();
    host.shared = nullptr;
    const ComputePipeline own(host, shaders, square());
    EXPECT_NE(own.get(), first);
    EXPECT_NE(own.get(), ComputePipeline(host, shaders, square()).get());
}

TEST_F(SharedObjectsTest, PipelinesOfAnyOtherSettingAreOthers)
{
    const ShaderLibrary shaders = test::testShaders();
    const ImageSetLayout one(context(), {.name = "one", .sampledCount = 1});
    const ImageSetLayout two(context(), {.name = "two", .sampledCount = 2});
    ASSERT_NE(one.get(), two.get());
    using Compute = std::function<void(ComputePipelineSettings&)>;
    std::set<VkPipeline> computes{ComputePipeline(context(), shaders, square()).get()};
    const std::vector<Compute> computeChanges{
        [](auto& settings) { settings.pushConstantBytes = 32; },
        [](auto& settings) { settings.constants = {{.id = 7, .value = 1}}; },
        [](auto& settings) { settings.constants = {{.id = 7, .value = 2}}; },
        [](auto& settings) { settings.constants = {{.id = 8, .value = 1}}; },
        [&](auto& settings) { settings.setLayouts = {one.get()}; },
        [&](auto& settings) { settings.setLayouts = {two.get()}; },
        [&](auto& settings) {
            settings.setLayouts = {one.get(), two.get()};
        }};
    for (const Compute& change : computeChanges) {
        ComputePipelineSettings settings = square();
        change(settings);
        computes.insert(ComputePipeline(context(), shaders, settings).get());
    }
    EXPECT_EQ(computes.size(), 1 + computeChanges.size());

    using Graphics = std::function<void(GraphicsPipelineSettings&)>;
    std::set<VkPipeline> draws{GraphicsPipeline(context(), shaders, corner()).get()};
    const std::vector<Graphics> changes{
        [](auto& settings) { settings.fragmentShader.clear(); },
        [](auto& settings) { settings.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP; },
        [](auto& settings) { settings.pushConstantBytes = 32; },
        [](auto& settings) { settings.constants = {{.id = 7, .value = 1}}; },
        [&](auto& settings) { settings.setLayouts = {one.get()}; },
        [](auto& settings) { settings.colorFormats = {VK_FORMAT_R16G16B16A16_SFLOAT}; },
        [](auto& settings) { settings.depthFormat = VK_FORMAT_D32_SFLOAT; },
        [](auto& settings) { settings.writtenColors = 0; },
        [](auto& settings) { settings.samples = 4; },
        [](auto& settings) { settings.depthTest = false; },
        [](auto& settings) { settings.depthWrite = false; },
        [](auto& settings) { settings.depthCompare = VK_COMPARE_OP_LESS; },
        [](auto& settings) { settings.cullMode = VK_CULL_MODE_BACK_BIT; },
        [](auto& settings) { settings.frontFace = VK_FRONT_FACE_CLOCKWISE; },
        [](auto& settings) { settings.blend = Blend::alpha; }};
    for (const Graphics& change : changes) {
        GraphicsPipelineSettings settings = corner();
        change(settings);
        draws.insert(GraphicsPipeline(context(), shaders, settings).get());
    }
    EXPECT_EQ(draws.size(), 1 + changes.size());
}

} // namespace
} // namespace sward::gpu
