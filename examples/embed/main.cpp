// A host with a Vulkan of its own, without a window, draws grass among its own boxes:
//   embed FIELD.sward OUT.png [forward] [render-pass] [raster]
// What Sward asks for stands at the numbers 1 to 7. For the rest, which any engine has, helpers of Sward's own serve.
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <png.h>
#include <shaders/box.frag.h>
#include <shaders/box.vert.h>
#include <sward/field/read.h>
#include <sward/gpu/check.h>
#include <sward/gpu/device_choice.h>
#include <sward/gpu/features.h>
#include <sward/gpu/readback.h>
#include <sward/gpu/graphics_pipeline.h>
#include <sward/gpu/commands.h>
#include <sward/gpu/rendering.h>
#include <sward/render/grass.h>

#include <cstdio>
#include <set>
#include <stdexcept>

using namespace sward;

namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB, depthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkExtent2D size{640, 360};
using Options = std::set<std::string_view>;

/// The host's own device, and all that Sward knows of it.
struct Vulkan {
    gpu::Instance instance;
    gpu::UniqueRoot<VkDevice, vkDestroyDevice> device;
    gpu::DeviceContext context;

    Vulkan()
    {
        // 1. A device that has what it must have, and what Sward uses of the rest; a host adds its own.
        const std::vector<gpu::DeviceReport> devices = gpu::listDevices(instance);
        const gpu::DeviceReport& chosen = devices[gpu::chooseDevice(devices, "")];
        gpu::FeatureChain wanted;
        const gpu::OptionalFeatures features = gpu::enableFeatures(chosen.physical, wanted);
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queues{
            VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, chosen.queueFamily, 1, &priority};
        const VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.core, 0, 1, &queues};
        VkDevice made = VK_NULL_HANDLE;
        gpu::check(vkCreateDevice(chosen.physical, &info, nullptr, &made), "vkCreateDevice");
        device = decltype(device)(made);
        VkQueue queue = VK_NULL_HANDLE;
        vkGetDeviceQueue(made, chosen.queueFamily, 0, &queue);
        context = gpu::describeDevice(chosen.physical, made, chosen.queueFamily, queue, features, false);
    }
};

using RenderPass = gpu::Unique<VkRenderPass, vkDestroyRenderPass>;
RenderPass makeRenderPass(VkDevice device)
{
    const VkAttachmentReference drawn{0, gpu::layoutOf(gpu::ImageUse::colorTarget)};
    const VkAttachmentReference tested{1, gpu::layoutOf(gpu::ImageUse::depthTarget)};
    constexpr auto one = VK_SAMPLE_COUNT_1_BIT;
    constexpr auto clear = VK_ATTACHMENT_LOAD_OP_CLEAR;
    const VkAttachmentDescription both[]{{0, colorFormat, one, clear, {}, {}, {}, drawn.layout, drawn.layout},
                                         {0, depthFormat, one, clear, {}, {}, {}, tested.layout, tested.layout}};
    const VkSubpassDescription subpass{0, VK_PIPELINE_BIND_POINT_GRAPHICS, 0, nullptr, 1, &drawn, nullptr, &tested};
    const VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, nullptr, 0, 2, both, 1, &subpass};
    VkRenderPass made = VK_NULL_HANDLE;
    gpu::check(vkCreateRenderPass(device, &info, nullptr, &made), "vkCreateRenderPass");
    return {device, made};
}

/// A cube from −1 to 1 as its shaders take it; the sun is turned as the cube is.
struct Push {
    glm::mat4 toClip;
    glm::vec4 color, sun;
};

void draw(const gpu::DeviceContext& context, const Options& options, const char* file, const char* drawn)
{
    const bool isReversed = !options.contains("forward"), hasRenderPass = options.contains("render-pass");
    const auto geometry = options.contains("raster") ? render::Geometry::raster : render::Geometry::automatic;
    // The host's picture, and what draws boxes there.
    const gpu::Image color(
        context, {"color", colorFormat, size, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    const gpu::Image depth(context, {"depth", depthFormat, size, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
    const RenderPass pass = hasRenderPass ? makeRenderPass(context.device) : RenderPass();
    const VkImageView views[]{color.view(), depth.view()};
    const VkFramebufferCreateInfo frameInfo{
        VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, nullptr, 0, pass.get(), 2, views, size.width, size.height, 1};
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (hasRenderPass)
        gpu::check(vkCreateFramebuffer(context.device, &frameInfo, nullptr, &framebuffer), "vkCreateFramebuffer");
    const gpu::Unique<VkFramebuffer, vkDestroyFramebuffer> owned(context.device, framebuffer);
    const EmbeddedFile shaders[]{{"box.vert.spv", {reinterpret_cast<const unsigned char*>(boxVert), sizeof boxVert}},
                                 {"box.frag.spv", {reinterpret_cast<const unsigned char*>(boxFrag), sizeof boxFrag}}};
    const gpu::GraphicsPipeline pipeline(context, gpu::ShaderLibrary(shaders),
                                         {.vertexShader = "box.vert",
                                          .fragmentShader = "box.frag",
                                          .pushConstantBytes = sizeof(Push),
                                          .colorFormats = {colorFormat},
                                          .depthFormat = depthFormat,
                                          .renderPass = pass.get(),
                                          .depthCompare = isReversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS});
    const auto inPicture = [&](VkCommandBuffer commands, const auto& drawAll) {
        const float far = isReversed ? 0.0f : 1.0f;
        const VkClearValue clear[]{{.color = {.float32 = {0.35f, 0.55f, 0.85f, 1.0f}}}, {.depthStencil = {far, 0}}};
        gpu::transition(commands, color, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        gpu::transition(commands, depth, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
        if (!hasRenderPass) {
            const gpu::ColorAttachment attachment{.view = color.view(), .clear = std::to_array(clear[0].color.float32)};
            const gpu::RenderingScope scope(commands, size, {&attachment, 1}, {{depth.view(), far}});
            return drawAll();
        }
        const VkRenderPassBeginInfo begin{
            VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, nullptr, pass.get(), framebuffer, {{}, size}, 2, clear};
        vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
        gpu::setArea(commands, size);
        drawAll();
        vkCmdEndRenderPass(commands);
    };

    // 2. A field needs no device to be read; it comes there by the host's own commands.
    field::MappedField mapped = field::readField(file);
    render::FrameSettings settings = render::FrameSettings::of(mapped.view());
    const auto lawn = std::make_shared<render::ResidentField>(context, std::move(mapped));
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();

    // 3. All grass of the world, and what it is drawn into.
    render::Grass grass(context, {.framesInFlight = 1});
    const render::BladeTarget target(
        context, {.colorFormats = {colorFormat}, .hasReversedZ = isReversed, .renderPass = pass.get()});

    // 4. The same lawn twice: on a slope, and half as large.
    const double extent = double(lawn->content().size().x);
    const render::Placement slope{{-2.2, 0.7, -1.0}, glm::angleAxis(-0.35, glm::dvec3(0.0, 0.0, 1.0)), 5.0 / extent};
    const render::Placement small{.position = {2.4, 0.0, 0.0}, .scale = 2.5 / extent};
    grass.add({lawn, slope});
    grass.add({lawn, small});

    // The host's world: a slab below each lawn, two posts in the grass, a block that rolls through it.
    settings.sunDirection = {-0.5f, 0.6f, 0.6f};
    const double nearest = isReversed ? 100.0 : 0.1, farthest = isReversed ? 0.1 : 100.0;
    const glm::dmat4 worldToClip =
        glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) *
        glm::perspectiveRH_ZO(0.62, double(size.width) / size.height, nearest, farthest) *
        glm::lookAt(glm::dvec3(0.3, 2.6, 7.0), glm::dvec3(-0.45, 0.45, 0.0), glm::dvec3(0, 1, 0));
    const render::HostView view{worldToClip, {size.width, size.height}, 1, isReversed, geometry};
    const auto at = [](glm::dvec3 place) { return glm::translate(glm::dmat4(1.0), place); };
    const auto box = [&](VkCommandBuffer commands, const glm::dmat4& place, glm::dvec3 half, glm::vec3 color) {
        const glm::vec3 sun = glm::normalize(settings.sunDirection) * glm::mat3(place);
        const glm::mat4 toClip(worldToClip * glm::scale(place, half));
        pipeline.push(commands, Push{toClip, glm::vec4(color, 1.0f), glm::vec4(sun, 0.0f)});
        vkCmdDraw(commands, 36, 1, 0, 0);
    };

    for (int frame = 0; frame <= 5; ++frame) {
        const glm::dvec3 ball(1.5 + 0.15 * frame, 0.15, 0.8);
        const render::HostCollider collider{ball, ball, 0.25, {0.75f, 0.0f, 0.0f}};

        // 5. A frame begins when the former one in its slot has completed.
        grass.begin(0, {.time = frame / 5.0, .views = {&view, 1}, .settings = settings, .colliders = {&collider, 1}});
        gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
            // 6. Outside of a rendering: blades move once, and are culled and rasterised for each view.
            grass.recordUpdate(commands);
            grass.recordCull(commands, 0);
            grass.recordRaster(commands, 0);
            inPicture(commands, [&] {
                pipeline.bind(commands);
                for (const render::Placement& p : {slope, small})
                    box(commands, at(p.position) * glm::mat4_cast(p.rotation) * at({0.0, -0.1, 0.0}),
                        {0.5 * p.scale * extent, 0.1, 0.5 * p.scale * extent}, {0.16f, 0.11f, 0.06f});
                box(commands, at({2.4, 0.35, 0.3}), {0.12, 0.5, 0.12}, {0.6f, 0.1f, 0.08f});
                box(commands, at({-1.2, 0.7, 0.2}), {0.15, 0.9, 0.15}, {0.7f, 0.6f, 0.4f});
                box(commands, at(ball), glm::dvec3(0.12), {0.9f, 0.75f, 0.1f});
                // 7. In the host's own rendering, among its own things.
                grass.recordDraw(commands, 0, target);
            });
        });
    }

    const std::vector<std::byte> pixels = gpu::readImage(context, color, gpu::ImageUse::colorTarget);
    png_image png{nullptr, PNG_IMAGE_VERSION, size.width, size.height, PNG_FORMAT_RGBA, 0, 0, 0, {}};
    if (png_image_write_to_file(&png, drawn, 0, pixels.data(), 0, nullptr) == 0)
        throw std::runtime_error(std::string(drawn) + ": " + png.message);
    std::printf("%s drew %u blades\n", context.name.c_str(), unsigned(grass.stats(0, 0).drawn));
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 3)
        throw std::runtime_error("usage: embed FIELD.sward OUT.png [forward] [render-pass] [raster]");
    draw(Vulkan().context, Options(argv + 3, argv + argc), argv[1], argv[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "embed: %s\n", error.what());
    return 1;
}
