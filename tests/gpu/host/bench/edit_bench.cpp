// Measures what an edit costs the frame that carries it out:
//   sward_edit_bench [CELLS_ALONG=32] [BLADES_PER_CELL=10000] [CELLS_PER_EDIT=4] [FRAMES=400]
//   [INSTANCES=0]
// Draws a field of 32 m cells; every fourth frame replaces some in its middle. Without instances
// FieldRenderer draws it, else that many of render::Grass, in one place. Prints one line of JSON:
// median and 99th percentile in milliseconds of frames with and without an edit, by the clock from
// the first call of the frame to the device's end, and of apply() or edit() alone.
#include "gpu/device/device.h"
#include "gpu/device/instance.h"
#include "gpu/memory/image.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/rendering.h"
#include "render/grass.h"
#include "render/viewer/field_renderer.h"
#include "support/fields/edited_meadow.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

namespace sward {
namespace {

constexpr VkExtent2D extent{1920, 1080};
constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr glm::dvec3 eye(-10.0, 8.0, -10.0);
constexpr glm::dvec3 lookedAt(30.0, 0.0, 30.0);

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double percentile(std::vector<double> seconds, double share)
{
    std::ranges::sort(seconds);
    return 1e3 * seconds[static_cast<std::size_t>(share * double(seconds.size() - 1))];
}

/// What draws the field and is edited.
class Door {
public:
    virtual ~Door() = default;
    virtual void edit(const field::Delta& delta) = 0;
    virtual void drawAndWait(double time) = 0;
};

class Renderer : public Door {
public:
    Renderer(const gpu::Device& device, const field::FieldView& field)
        : context_(device.context())
        , renderer_(device, field, settings())
        , target_(context_,
                  {.name = "picture",
                   .format = colorFormat,
                   .extent = extent,
                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT})
        , frame_(render::FrameSettings::of(field))
    {
        camera_.eye = eye;
        camera_.target = lookedAt;
    }

    void edit(const field::Delta& delta) override { renderer_.apply(delta); }

    void drawAndWait(double time) override
    {
        gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
            gpu::transition(commands, target_, gpu::ImageUse::undefined,
                            gpu::ImageUse::colorTarget);
            renderer_.record(commands,
                             {target_.get(), target_.view(), {extent.width, extent.height}},
                             camera_, frame_, time);
        });
    }

private:
    static render::FieldRenderer::Settings settings()
    {
        render::FieldRenderer::Settings settings;
        settings.colorFormat = colorFormat;
        settings.isEditable = true;
        return settings;
    }

    const gpu::DeviceContext& context_;
    render::FieldRenderer renderer_;
    gpu::Image target_;
    render::Camera camera_;
    render::FrameSettings frame_;
};

/// Stores the light into the host's picture.
class Host : public Door {
public:
    Host(const gpu::Device& device, const field::OwnedField& field, long instances)
        : context_(device.context())
        , lawn_(std::make_shared<render::ResidentField>(
              context_, field, render::FieldBudget{.framesInFlight = 1, .isEditable = true}))
        , grass_(context_, {.framesInFlight = 1})
        , picture_(context_, {.name = "picture",
                              .format = VK_FORMAT_R8G8B8A8_UNORM,
                              .extent = extent,
                              .usage = VK_IMAGE_USAGE_STORAGE_BIT})
        , frame_(render::FrameSettings::of(field.view()))
    {
        gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
            lawn_->recordUpload(commands);
            gpu::transition(commands, picture_, gpu::ImageUse::undefined, gpu::ImageUse::storage);
        });
        lawn_->releaseStaging();
        for (long i = 0; i < instances; ++i)
            grass_.add({lawn_, {}});
        view_.worldToClip =
            glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) *
            glm::perspectiveRH_ZO(0.7, double(extent.width) / extent.height, 1000.0, 0.1) *
            glm::lookAt(eye, lookedAt, {0.0, 1.0, 0.0});
        view_.size = {extent.width, extent.height};
        view_.geometry = render::Geometry::raster;
        view_.stored = render::StoredPicture{.color = picture_.view(),
                                             .format = VK_FORMAT_R8G8B8A8_UNORM,
                                             .isSrgb = true,
                                             .size = {extent.width, extent.height}};
    }

    void edit(const field::Delta& delta) override { grass_.edit(*lawn_, delta); }

    void drawAndWait(double time) override
    {
        grass_.begin(0, {.time = time, .views = {&view_, 1}, .settings = frame_});
        gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
            grass_.recordUpdate(commands);
            grass_.recordCull(commands, 0);
            grass_.recordRaster(commands, 0);
        });
    }

private:
    const gpu::DeviceContext& context_;
    std::shared_ptr<render::ResidentField> lawn_;
    render::Grass grass_;
    gpu::Image picture_;
    render::HostView view_;
    render::FrameSettings frame_;
};

int run(std::int64_t along, std::size_t blades, std::int64_t perEdit, int frames, long instances)
{
    test::EditedMeadow meadow(32.0f * float(along));
    for (std::int64_t x = 0; x < along; ++x)
        for (std::int64_t z = 0; z < along; ++z)
            meadow.sow({x - along / 2, 0, z - along / 2}, blades);
    meadow.changes();
    const auto field = std::make_shared<const field::Field>(meadow.whole());
    const gpu::Instance instance;
    const gpu::Device device(instance);
    const std::unique_ptr<Door> door =
        instances > 0 ? std::unique_ptr<Door>(new Host(device, field, instances))
                      : std::unique_ptr<Door>(new Renderer(device, field::viewOf(*field)));

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
            door->edit(delta);
        const double apply = secondsSince(start);
        const auto begin = std::chrono::steady_clock::now();
        door->drawAndWait(i / 60.0);
        // The first frames create pipelines.
        if (i < frames / 10)
            continue;
        (edits ? edited : plain).push_back(secondsSince(begin));
        if (edits)
            applied.push_back(apply);
    }
    std::printf("{\"device\":\"%s\",\"instances\":%ld,\"blades\":%zu,\"edited\":%zu,"
                "\"frame_ms\":[%.3f,%.3f],"
                "\"edit_frame_ms\":[%.3f,%.3f],\"apply_ms\":[%.3f,%.3f]}\n",
                device.context().name.c_str(), instances, meadow.bladeCount(),
                blades * std::size_t(perEdit), percentile(plain, 0.5), percentile(plain, 0.99),
                percentile(edited, 0.5), percentile(edited, 0.99), percentile(applied, 0.5),
                percentile(applied, 0.99));
    return 0;
}

} // namespace
} // namespace sward

int main(int argc, char** argv)
{
    const auto number = [&](int i, long usual) { return argc > i ? std::atol(argv[i]) : usual; };
    return sward::run(number(1, 32), std::size_t(number(2, 10'000)), number(3, 4),
                      int(number(4, 400)), number(5, 0));
}
