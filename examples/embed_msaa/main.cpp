// A second host. Two players share one picture: four samples per pixel, a render pass that resolves them, depths from
// 0 near to 1 far. Both walk over one field, which streams if a budget of device memory does not hold all of it:
//   embed_msaa FIELD.sward OUT.png [--budget MIB] [--reversed] [--raster]
// Numbers 1 to 6 mark what differs from examples/embed. --reversed and --raster draw the same picture in other ways.
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
#include <sward/render/grass.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>

using namespace sward;

namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB, depthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkExtent2D size{512, 288}, half{size.width / 2, size.height};
constexpr std::uint32_t samples = 4, players = 2;
constexpr int walkedFrames = 8, allFrames = 36; // the players walk, then stand

/// The host's own device, as in examples/embed.
struct Vulkan {
    gpu::Instance instance;
    gpu::UniqueRoot<VkDevice, vkDestroyDevice> device;
    gpu::DeviceContext context;

    Vulkan()
    {
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

/// 1. The render pass clears and resolves, makes all transitions of layouts, and orders itself among other commands.
gpu::Unique<VkRenderPass, vkDestroyRenderPass> makeRenderPass(VkDevice device)
{
    constexpr auto four = VK_SAMPLE_COUNT_4_BIT, one = VK_SAMPLE_COUNT_1_BIT;
    constexpr auto clear = VK_ATTACHMENT_LOAD_OP_CLEAR, fresh = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    constexpr auto keep = VK_ATTACHMENT_STORE_OP_STORE, drop = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    constexpr auto before = VK_IMAGE_LAYOUT_UNDEFINED, after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkAttachmentReference drawn{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, resolved{2, drawn.layout};
    constexpr VkAttachmentReference tested{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentDescription all[]{{0, colorFormat, four, clear, drop, fresh, drop, before, drawn.layout},
                                        {0, depthFormat, four, clear, drop, fresh, drop, before, tested.layout},
                                        {0, colorFormat, one, fresh, keep, fresh, drop, before, after}};
    const VkSubpassDescription subpass{0, VK_PIPELINE_BIND_POINT_GRAPHICS, 0, nullptr, 1, &drawn, &resolved, &tested};
    constexpr auto outside = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, inside = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
    constexpr VkAccessFlags any = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    const VkSubpassDependency order[]{{VK_SUBPASS_EXTERNAL, 0, outside, inside, any, any, 0},
                                      {0, VK_SUBPASS_EXTERNAL, inside, outside, any, any, 0}};
    const VkRenderPassCreateInfo info{
        VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, nullptr, 0, 3, all, 1, &subpass, 2, order};
    VkRenderPass made = VK_NULL_HANDLE;
    gpu::check(vkCreateRenderPass(device, &info, nullptr, &made), "vkCreateRenderPass");
    return {device, made};
}

/// What the host draws itself: cubes from −1 to 1 that are moved and stretched [m]. The first is the ground.
constexpr glm::dvec3 boxes[][2]{
    {{0.0, -0.2, 0.0}, {10.0, 0.2, 10.0}}, {{-8.2, 0.4, -9.0}, {0.1, 0.6, 0.1}}, {{8.2, 0.4, 9.0}, {0.1, 0.6, 0.1}}};

void draw(const gpu::DeviceContext& context, const std::vector<std::string>& words)
{
    const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
    const auto budget = std::ranges::find(words, "--budget");
    const std::uint64_t bytes = words.end() - budget > 1 ? std::stoull(budget[1]) << 20 : 0; // 0: unlimited
    const bool isReversed = has("--reversed");
    const auto geometry = has("--raster") ? render::Geometry::raster : render::Geometry::automatic;

    const auto pass = makeRenderPass(context.device);
    constexpr VkImageUsageFlags colors = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const gpu::Image color(context, {"color", colorFormat, size, colors, 1, samples});
    const gpu::Image depth(context,
                           {"depth", depthFormat, size, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 1, samples});
    const gpu::Image resolved(context, {"resolved", colorFormat, size, colors | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    const VkImageView images[]{color.view(), depth.view(), resolved.view()};
    const VkFramebufferCreateInfo frameInfo{
        VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, nullptr, 0, pass.get(), 3, images, size.width, size.height, 1};
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    gpu::check(vkCreateFramebuffer(context.device, &frameInfo, nullptr, &framebuffer), "vkCreateFramebuffer");
    const gpu::Unique<VkFramebuffer, vkDestroyFramebuffer> owned(context.device, framebuffer);
    const EmbeddedFile shaders[]{{"box.vert.spv", {reinterpret_cast<const unsigned char*>(boxVert), sizeof boxVert}},
                                 {"box.frag.spv", {reinterpret_cast<const unsigned char*>(boxFrag), sizeof boxFrag}}};
    gpu::GraphicsPipelineSettings drawing{.vertexShader = "box.vert", .fragmentShader = "box.frag"};
    drawing.pushConstantBytes = sizeof(glm::mat4);
    drawing.colorFormats = {colorFormat};
    drawing.depthFormat = depthFormat;
    drawing.renderPass = pass.get();
    drawing.samples = samples;
    drawing.depthCompare = isReversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    const gpu::GraphicsPipeline pipeline(context, gpu::ShaderLibrary(shaders), drawing);

    // 2. A budget for the field, one instance of it and the lists of both views. The field keeps the file
    // mapped: pages are copied from there. Pictures that must not depend on the disk wait for it; games do not.
    field::MappedField mapped = field::readField(words[0]);
    const render::FrameSettings settings = render::FrameSettings::of(mapped.view());
    const render::FieldBudget limit{
        .bytes = bytes, .instances = 1, .views = players, .framesInFlight = 1, .waitsForDisk = true};
    const auto lawn = std::make_shared<render::ResidentField>(context, std::move(mapped), limit);
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();

    // 3. A view for each player. The target has the picture's samples, convention of depth and render pass.
    render::Grass grass(context, {.framesInFlight = 1, .maxViews = players});
    grass.add({lawn, {}});
    render::HostTarget description{.colorFormats = {colorFormat}, .samples = samples, .hasReversedZ = isReversed};
    description.renderPass = pass.get();
    const render::BladeTarget target(context, description);

    // 4. From the middle of a field of 20 m × 20 m, at y = 0, each player walks to one of its corners.
    const auto viewOf = [&](double side, double metres) {
        const glm::dvec3 outwards = glm::normalize(glm::dvec3(side, 0.0, side)), up(0.0, 1.0, 0.0);
        const glm::dvec3 eye = metres * outwards + 1.5 * up;
        const double aspect = double(half.width) / half.height, nearest = isReversed ? 100.0 : 0.1;
        const glm::dmat4 toClip = glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) *
                                  glm::perspectiveRH_ZO(0.7, aspect, nearest, 10.0 / nearest) *
                                  glm::lookAt(eye, eye + outwards - 0.5 * up, up);
        return render::HostView{toClip, {half.width, half.height}, samples, isReversed, geometry};
    };

    for (int frame = 0; frame < allFrames; ++frame) {
        const double way = 9.0 * std::min(1.0, double(frame) / walkedFrames);
        const render::HostView views[players]{viewOf(-1.0, way), viewOf(1.0, way)};
        grass.begin(0, {.time = frame / 10.0, .views = views, .settings = settings});
        gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
            // 5. Pages come and blades move once for all views; each view is culled and rasterised.
            grass.recordUpdate(commands);
            for (std::uint32_t player = 0; player < players; ++player) {
                grass.recordCull(commands, player);
                grass.recordRaster(commands, player);
            }
            const VkClearValue clear[]{{.color = {.float32 = {0.35f, 0.55f, 0.85f, 1.0f}}},
                                       {.depthStencil = {isReversed ? 0.0f : 1.0f, 0}}};
            const VkRenderPassBeginInfo begin{
                VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, nullptr, pass.get(), framebuffer, {{}, size}, 2, clear};
            vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
            for (std::uint32_t player = 0; player < players; ++player) {
                // 6. The viewport is the player's half of the picture, and as large as the view.
                const VkRect2D area{{std::int32_t(player * half.width), 0}, half};
                const VkViewport viewport{float(player * half.width), 0, float(half.width), float(half.height), 0, 1};
                vkCmdSetViewport(commands, 0, 1, &viewport);
                vkCmdSetScissor(commands, 0, 1, &area);
                pipeline.bind(commands);
                for (std::uint32_t i = 0; i < std::size(boxes); ++i) {
                    const glm::dmat4 placed = glm::scale(glm::translate(glm::dmat4(1.0), boxes[i][0]), boxes[i][1]);
                    pipeline.push(commands, glm::mat4(views[player].worldToClip * placed));
                    vkCmdDraw(commands, 36, 1, 0, i);
                }
                grass.recordDraw(commands, player, target);
            }
            vkCmdEndRenderPass(commands);
        });
    }

    const std::vector<std::byte> pixels = gpu::readImage(context, resolved, gpu::ImageUse::transferSource);
    png_image png{nullptr, PNG_IMAGE_VERSION, size.width, size.height, PNG_FORMAT_RGBA, 0, 0, 0, {}};
    if (png_image_write_to_file(&png, words[1].c_str(), 0, pixels.data(), 0, nullptr) == 0)
        throw std::runtime_error(words[1] + ": " + png.message);
    const render::StreamingStats pages = grass.streamingStats();
    std::printf("%s drew %ju and %ju blades\n", context.name.c_str(), grass.stats(0, 0).drawn, grass.stats(1, 0).drawn);
    std::printf("%ju pages, %ju fit, %ju resident, %ju wanted, %ju missing, thinning %.2f, %s\n", pages.pages,
                pages.places, pages.residentPages, pages.wantedPages, pages.missingPages, double(pages.thinning),
                pages.isSettled ? "settled" : "not settled");
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 3)
        throw std::runtime_error("usage: embed_msaa FIELD.sward OUT.png [--budget MIB] [--reversed] [--raster]");
    draw(Vulkan().context, {argv + 1, argv + argc});
} catch (const std::exception& error) {
    std::fprintf(stderr, "embed_msaa: %s\n", error.what());
    return 1;
}
