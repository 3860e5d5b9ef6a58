// Measures what an edit costs the frame that carries it out:
//   sward_edit_bench [CELLS_ALONG=32] [BLADES_PER_CELL=10000] [CELLS_PER_EDIT=4] [FRAMES=400]
// Draws a field of 32 m cells; every fourth frame replaces some in its middle. Prints one line of
// JSON: median and 99th percentile in milliseconds of frames with and without an edit, by the clock
// from the first command recorded to the device's end, and of apply() alone.
#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/image.h"
#include "gpu/image_use.h"
#include "gpu/instance.h"
#include "render/field_renderer.h"
#include "support/fields/edited_meadow.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace sward {
namespace {

constexpr VkExtent2D extent{1920, 1080};

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double percentile(std::vector<double> seconds, double share)
{
    std::ranges::sort(seconds);
    return 1e3 * seconds[static_cast<std::size_t>(share * double(seconds.size() - 1))];
}

int run(std::int64_t along, std::size_t blades, std::int64_t perEdit, int frames)
{
    test::EditedMeadow meadow(32.0f * float(along));
    for (std::int64_t x = 0; x < along; ++x)
        for (std::int64_t z = 0; z < along; ++z)
            meadow.sow({x - along / 2, 0, z - along / 2}, blades);
    meadow.changes();
    const field::Field field = meadow.whole();
    const gpu::Instance instance;
    const gpu::Device device(instance);
    render::FieldRenderer::Settings settings;
    settings.isEditable = true;
    render::FieldRenderer renderer(device, field::viewOf(field), settings);
    const gpu::Image target(device.context(), {.name = "picture",
                                               .format = settings.colorFormat,
                                               .extent = extent,
                                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                        VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    render::Camera camera;
    camera.eye = {-10.0, 8.0, -10.0};
    camera.target = {30.0, 0.0, 30.0};
    const auto frameSettings = render::FrameSettings::of(field::viewOf(field));

    std::vector<double> plain;
    std::vector<double> edited;
    std::vector<double> applied;
    for (int i = 0; i < frames; ++i) {
        const bool edits = i % 4 == 3;
        if (edits)
            for (std::int64_t c = 0; c < perEdit; ++c)
                meadow.sow({c % 2, 0, c / 2}, blades, 0.9, std::uint64_t(i));
        const field::Delta delta = meadow.changes();
        const auto start = std::chrono::steady_clock::now();
        if (edits)
            renderer.apply(delta);
        const double apply = secondsSince(start);
        const auto begin = std::chrono::steady_clock::now();
        gpu::submitAndWait(device.context(), [&](VkCommandBuffer commands) {
            gpu::transition(commands, target, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
            renderer.record(commands, {target.get(), target.view(), {extent.width, extent.height}},
                            camera, frameSettings, i / 60.0);
        });
        // The first frames create pipelines.
        if (i < frames / 10)
            continue;
        (edits ? edited : plain).push_back(secondsSince(begin));
        if (edits)
            applied.push_back(apply);
    }
    std::printf("{\"device\":\"%s\",\"blades\":%zu,\"edited\":%zu,\"frame_ms\":[%.3f,%.3f],"
                "\"edit_frame_ms\":[%.3f,%.3f],\"apply_ms\":[%.3f,%.3f]}\n",
                device.context().name.c_str(), meadow.bladeCount(), blades * std::size_t(perEdit),
                percentile(plain, 0.5), percentile(plain, 0.99), percentile(edited, 0.5),
                percentile(edited, 0.99), percentile(applied, 0.5), percentile(applied, 0.99));
    return 0;
}

} // namespace
} // namespace sward

int main(int argc, char** argv)
{
    const auto number = [&](int i, long usual) { return argc > i ? std::atol(argv[i]) : usual; };
    return sward::run(number(1, 32), std::size_t(number(2, 10'000)), number(3, 4),
                      int(number(4, 400)));
}
