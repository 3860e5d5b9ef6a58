// A host that changes grass while it draws it. The host bakes a lawn in its own process and keeps
// the bake open. A barrow is pushed over the lawn: it treads grass down, and ends where a fire has
// burned a circle. Then all of it is taken back:
//   embed_paint PAINTED.png UNDONE.png
// Numbers 1 to 5 mark what differs from examples/embed.
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <png.h>
#include <shaders/box.frag.h>
#include <shaders/box.vert.h>
#include <sward/bake/session.h>
#include <sward/bake/meadow.h>
#include <sward/gpu/check.h>
#include <sward/gpu/device_choice.h>
#include <sward/gpu/features.h>
#include <sward/gpu/readback.h>
#include <sward/gpu/graphics_pipeline.h>
#include <sward/gpu/commands.h>
#include <sward/gpu/rendering.h>
#include <sward/render/grass.h>
#include <sward/terrain/load.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

using namespace sward;

namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB, depthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkExtent2D size{640, 360};
constexpr int pushedFrames = 8, allFrames = 10; // of half a second

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

/// A cube from −1 to 1 as its shaders take it.
struct Push {
    glm::mat4 toClip;
    glm::vec4 color, sun;
};

/// The way of the barrow over the plane [m].
glm::dvec3 wayAt(double t)
{
    return {-6.0 + 9.0 * t, 0.0, 5.5 - 8.0 * t + 1.6 * std::sin(5.0 * t)};
}

void draw(const gpu::DeviceContext& context, const char* painted, const char* undone)
{
    // 1. The bake stays open: it keeps the ground, and bakes again what strokes reach.
    Diagnostics diagnostics;
    Progress progress;
    const terrain::GroundMesh ground = terrain::load("plane", {}, diagnostics);
    bake::BakeSettings wanted;
    wanted.meadow = bake::loadMeadow("meadow");
    wanted.density = 500.0;
    wanted.bladeScale = 1.5;
    bake::Session session(ground, wanted, 0, diagnostics, progress);

    // 2. The field may be edited. Nothing else differs.
    field::Field field = session.field();
    render::FrameSettings settings = render::FrameSettings::of(field::viewOf(field));
    const auto lawn = std::make_shared<render::ResidentField>(
        context, std::move(field), render::FieldBudget{.framesInFlight = 1, .isEditable = true});
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();
    render::Grass grass(context, {.framesInFlight = 1});
    grass.add({lawn, {}});
    const render::BladeTarget target(context, {.colorFormats = {colorFormat}});

    const gpu::Image color(
        context, {"color", colorFormat, size, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    const gpu::Image depth(context, {"depth", depthFormat, size, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
    const EmbeddedFile shaders[]{{"box.vert.spv", {reinterpret_cast<const unsigned char*>(boxVert), sizeof boxVert}},
                                 {"box.frag.spv", {reinterpret_cast<const unsigned char*>(boxFrag), sizeof boxFrag}}};
    const gpu::GraphicsPipeline pipeline(context, gpu::ShaderLibrary(shaders),
                                         {.vertexShader = "box.vert",
                                          .fragmentShader = "box.frag",
                                          .pushConstantBytes = sizeof(Push),
                                          .colorFormats = {colorFormat},
                                          .depthFormat = depthFormat});
    settings.sunDirection = {-0.6f, 0.7f, 0.3f};
    const glm::dmat4 worldToClip = glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) *
                                   glm::perspectiveRH_ZO(0.72, double(size.width) / size.height, 100.0, 0.1) *
                                   glm::lookAt(glm::dvec3(-2.0, 7.0, 9.5), {-1.0, 0.0, 0.9}, {0, 1, 0});
    const render::HostView view{.worldToClip = worldToClip, .size = {size.width, size.height}};
    const auto box = [&](VkCommandBuffer commands, glm::dvec3 place, glm::dvec3 half, glm::vec3 colored) {
        const glm::mat4 toClip(worldToClip * glm::scale(glm::translate(glm::dmat4(1.0), place), half));
        pipeline.push(commands, Push{toClip, glm::vec4(colored, 1.0f), glm::vec4(settings.sunDirection, 0.0f)});
        vkCmdDraw(commands, 36, 1, 0, 0);
    };
    double time = 0.0;
    const auto drawFrame = [&](glm::dvec3 barrow) {
        grass.begin(0, {.time = time += 0.5, .views = {&view, 1}, .settings = settings});
        gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
            // 3. What was edited is copied here, and blades that stay go on moving.
            grass.recordUpdate(commands);
            grass.recordCull(commands, 0);
            grass.recordRaster(commands, 0);
            gpu::transition(commands, color, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
            gpu::transition(commands, depth, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
            const gpu::ColorAttachment attachment{.view = color.view(), .clear = {{0.35f, 0.55f, 0.85f, 1.0f}}};
            const gpu::RenderingScope scope(commands, size, {&attachment, 1}, {{depth.view(), 0.0f}});
            pipeline.bind(commands);
            box(commands, {0.0, -0.1, 0.0}, {10.0, 0.1, 10.0}, {0.06f, 0.07f, 0.02f});
            box(commands, barrow + glm::dvec3(0.0, 0.45, 0.0), {0.35, 0.35, 0.45}, {0.6f, 0.1f, 0.08f});
            grass.recordDraw(commands, 0, target);
        });
    };
    const auto write = [&](const char* file) {
        const std::vector<std::byte> pixels = gpu::readImage(context, color, gpu::ImageUse::colorTarget);
        png_image png{nullptr, PNG_IMAGE_VERSION, size.width, size.height, PNG_FORMAT_RGBA, 0, 0, 0, {}};
        if (png_image_write_to_file(&png, file, 0, pixels.data(), 0, nullptr) == 0)
            throw std::runtime_error(std::string(file) + ": " + png.message);
    };

    // 4. A change is a new list of all strokes, so undo is a shorter one. Points are in
    // millimetres.
    bake::Strokes strokes;
    const auto point = [](glm::dvec3 at) {
        return std::array<std::int64_t, 3>{std::llround(1e3 * at.x), std::llround(1e3 * at.y),
                                           std::llround(1e3 * at.z)};
    };
    int edits = 0;
    std::size_t cells = 0;
    const auto apply = [&] {
        const bake::Session::Change change = session.apply(strokes, progress);
        grass.edit(*lawn, session.deltaOf(change.cells));
        ++edits;
        cells += change.cells.size();
    };
    bake::Stroke track{.kind = bake::StrokeKind::trodden, .radius = 0.7, .value = 0.25, .species = {}};
    bake::Stroke fire{.kind = bake::StrokeKind::erase, .radius = 1.3, .hardness = 0.8, .species = {}};
    fire.points = {point(wayAt(1.0) + glm::dvec3(0.8, 0.0, 0.4))};
    strokes.list = {fire};
    apply();
    for (int frame = 0; frame < allFrames; ++frame) {
        const double t = std::min(1.0, double(frame) / pushedFrames);
        // 5. Between two frames the track has become longer.
        if (frame <= pushedFrames) {
            track.points.push_back(point(wayAt(t)));
            strokes.list = {fire, track};
            apply();
        }
        drawFrame(wayAt(t));
    }
    write(painted);
    const auto drawn = grass.stats(0, 0).drawn;
    strokes.list.clear();
    apply();
    for (int frame = 0; frame < allFrames - pushedFrames; ++frame)
        drawFrame(wayAt(1.0));
    write(undone);
    std::printf("%s drew %u and %u blades; %d edits baked %zu cells again\n", context.name.c_str(), unsigned(drawn),
                unsigned(grass.stats(0, 0).drawn), edits, cells);
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc != 3)
        throw std::runtime_error("usage: embed_paint PAINTED.png UNDONE.png");
    draw(Vulkan().context, argv[1], argv[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "embed_paint: %s\n", error.what());
    return 1;
}
