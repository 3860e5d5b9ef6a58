// A host with a Vulkan of its own, without a window, draws grass among its own boxes:
//   embed FIELD.sward OUT.png [forward] [render-pass]
// What Sward asks for stands at the numbers 1 to 7, the features at Host's constructor.
#include "host.h"

#include <glm/ext/matrix_transform.hpp>
#include <sward/field/read.h>
#include <sward/render/grass.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace field = sward::field;
namespace gpu = sward::gpu;
namespace render = sward::render;

namespace {

/// Depth convention and rendering scope, as the words after the paths say.
bool isAsked(int argc, char** argv, std::string_view word)
{
    return std::find(argv + 3, argv + argc, word) != argv + argc;
}

/// A box of this size under a placement, its top at the placement's ground.
Box slab(const render::Placement& placement, double width)
{
    const glm::dvec3 low = placement.position - placement.rotation * glm::dvec3(0.0, 0.1, 0.0);
    return {glm::translate(glm::dmat4(1.0), low) * glm::dmat4(glm::mat4_cast(placement.rotation)) *
                glm::scale(glm::dmat4(1.0), {0.5 * width, 0.1, 0.5 * width}),
            {0.16f, 0.11f, 0.06f}};
}

Box block(glm::dvec3 middle, glm::dvec3 half, glm::vec3 color)
{
    return {glm::translate(glm::dmat4(1.0), middle) * glm::scale(glm::dmat4(1.0), half), color};
}

void draw(const Host& host, const char* fieldPath, const char* picturePath)
{
    // 1. The device's context, which outlives all grass.
    const gpu::DeviceContext context =
        gpu::describeDevice(host.physical, host.device, 0, host.queue, host.features, false);

    // 2. A field needs no device to be read; it comes there by the host's own commands.
    const field::MappedField mapped = field::readField(fieldPath);
    const auto lawn = std::make_shared<render::ResidentField>(context, mapped.view());
    host.submitAndWait([&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();

    // 3. All grass of the world, and what it is drawn into.
    render::Grass grass(context, {.framesInFlight = 1});
    render::HostTarget scope{.colorFormats = {colorFormat}, .depthFormat = depthFormat};
    scope.hasReversedZ = host.isReversed;
    scope.renderPass = host.renderPass;
    const render::BladeTarget target(context, scope);

    // 4. The same lawn twice: on a slope, and half as large.
    const double extent = static_cast<double>(lawn->content().size().x);
    const render::Placement slope{.position = {-2.2, 0.7, -1.0},
                                  .rotation = glm::angleAxis(-0.35, glm::dvec3(0.0, 0.0, 1.0)),
                                  .scale = 5.0 / extent};
    const render::Placement small{.position = {2.4, 0.0, 0.0}, .scale = 2.5 / extent};
    grass.add({lawn, slope});
    grass.add({lawn, small});

    // The host's world: slabs below, posts that stand in the grass, a block that rolls through it.
    std::vector<Box> boxes{slab(slope, 5.0), slab(small, 2.5),
                           block({2.4, 0.35, 0.3}, {0.12, 0.5, 0.12}, {0.6f, 0.1f, 0.08f}),
                           block({-1.2, 0.7, 0.2}, {0.15, 0.9, 0.15}, {0.7f, 0.6f, 0.4f}), Box{}};
    render::FrameSettings settings = render::FrameSettings::of(mapped.view());
    settings.sunDirection = {-0.5f, 0.6f, 0.6f};
    const glm::dmat4 worldToClip =
        host.projection(0.62) *
        glm::lookAt(glm::dvec3(0.3, 2.6, 7.0), glm::dvec3(-0.45, 0.45, 0.0), glm::dvec3(0, 1, 0));
    const render::HostView view{
        .worldToClip = worldToClip, .size = {size.width, size.height}, .hasReversedZ = host.isReversed};

    for (int frame = 0; frame <= 5; ++frame) {
        const glm::dvec3 ball(1.5 + 0.15 * frame, 0.15, 0.8);
        boxes.back() = block(ball, glm::dvec3(0.12), {0.9f, 0.75f, 0.1f});
        const render::HostCollider colliders[]{
            {.from = ball, .to = ball, .radius = 0.25, .velocity = {0.75f, 0.0f, 0.0f}}};

        // 5. A frame begins when the former one in its slot has completed.
        grass.begin(0, {.time = frame / 5.0, .views = {&view, 1}, .settings = settings, .colliders = colliders});
        host.submitAndWait([&](VkCommandBuffer commands) {
            // 6. Outside of a rendering: blades move once, and are judged for each view.
            grass.recordUpdate(commands);
            grass.recordCull(commands, 0);
            // 7. In the host's own rendering, among its own things.
            host.beginPicture(commands);
            host.draw(commands, boxes, worldToClip, settings.sunDirection);
            const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
            const VkRect2D all{{0, 0}, size};
            vkCmdSetViewport(commands, 0, 1, &viewport);
            vkCmdSetScissor(commands, 0, 1, &all);
            grass.recordDraw(commands, 0, target);
            host.endPicture(commands);
        });
    }
    host.save(picturePath);
    std::printf("%s drew %llu blades\n", context.name.c_str(),
                static_cast<unsigned long long>(grass.stats(0, 0).drawn));
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 3)
        throw std::runtime_error("usage: embed FIELD.sward OUT.png [forward] [render-pass]");
    draw(Host(!isAsked(argc, argv, "forward"), isAsked(argc, argv, "render-pass")), argv[1], argv[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "embed: %s\n", error.what());
    return 1;
}
