// Measures the cost of grass in a host's frames, by either method of drawing:
//   sward_host_bench FIELD.sward SCENE.json [raster|tessellation] [samples=N] [instances=N]
//   [frames=N] [lamps=N] [ambient=1] [shadow=1] [budget=MIB] [fly=1] [speed=M/S] [each=1] [store=1]
//   [clock=1] [sow=THREADS] [sown=MIB] [shaders=1]
// With store the light is stored into the host's picture of one sample, with store=2 also the
// depth; there is no composite, and "draw" is empty. With a budget the field is streamed if it does
// not fit; fly follows the scene's moving camera there and back, speed circles over the field at
// that speed, 3 m above the blades. The host's depth is at the far plane; Sward processes it like
// any other. A flight moves on by a 60th of a second with each frame, with clock by the time that
// has passed; sow and sown are for a field with seeds,
// shaders has a CPU device sow by them. Prints one line of JSON: medians in
// milliseconds by device timestamps, and by the clock for the CPU and whole frames; of a flight,
// how near blades were missing. With each, also a line for each frame.
#include "field/read.h"
#include "flight.h"
#include "gpu/context/check.h"
#include "gpu/device/device.h"
#include "gpu/memory/image.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/rendering.h"
#include "gpu/recording/timestamps.h"
#include "render/grass.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace sward {
namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkExtent2D extent{1920, 1080};
constexpr std::uint32_t slots = 2;

struct Options {
    std::string field;
    std::string scene;
    render::Geometry geometry = render::Geometry::raster;
    std::map<std::string, int> numbers{
        {"samples", 1}, {"instances", 1}, {"frames", 300}, {"radiance", 0}, {"lamps", 0},
        {"ambient", 0}, {"shadow", 0},    {"budget", 0},   {"fly", 0},      {"store", 0},
        {"speed", 0},   {"each", 0},      {"clock", 0},    {"sow", 1},      {"sown", 512},
        {"shaders", 0}};
};

Options optionsOf(int argc, char** argv)
{
    Options options{argv[1], argv[2]};
    for (int i = 3; i < argc; ++i) {
        const std::string word = argv[i];
        const std::size_t equals = word.find('=');
        if (equals != std::string::npos)
            options.numbers.at(word.substr(0, equals)) = std::stoi(word.substr(equals + 1));
        else
            options.geometry =
                word == "tessellation" ? render::Geometry::tessellation : render::Geometry::raster;
    }
    return options;
}

glm::dvec3 vectorOf(const nlohmann::json& values)
{
    return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

/// Reversed Z, the far plane at infinity.
glm::dmat4 worldToClip(const nlohmann::json& camera)
{
    const double focal = 1.0 / std::tan(0.5 * glm::radians(camera.at("fov_y_deg").get<double>()));
    glm::dmat4 projection(0.0);
    projection[0][0] = focal * extent.height / extent.width;
    projection[1][1] = -focal;
    projection[3][2] = 0.1;
    projection[2][3] = -1.0;
    return projection * glm::lookAt(vectorOf(camera.at("eye")), vectorOf(camera.at("target")),
                                    glm::dvec3(0.0, 1.0, 0.0));
}

/// The scene's moving camera at a time [s]: there, back, and again.
nlohmann::json cameraAt(const nlohmann::json& path, double time)
{
    const double last = path.back().at("time").get<double>();
    const double phase = std::fmod(time, 2.0 * last);
    const double at = phase < last ? phase : 2.0 * last - phase;
    std::size_t next = 1;
    while (next + 1 < path.size() && path[next].at("time").get<double>() < at)
        ++next;
    const nlohmann::json& from = path[next - 1];
    const nlohmann::json& to = path[next];
    const double begun = from.at("time").get<double>();
    const double share = (at - begun) / (to.at("time").get<double>() - begun);
    nlohmann::json camera = from;
    for (const char* key : {"eye", "target"}) {
        const glm::dvec3 place = glm::mix(vectorOf(from.at(key)), vectorOf(to.at(key)), share);
        camera[key] = {place.x, place.y, place.z};
    }
    return camera;
}

/// Median, 99th percentile and maximum.
nlohmann::json spreadOf(const std::vector<double>& values)
{
    const gpu::Statistics found = gpu::statisticsOf(values);
    const double most = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
    return {{"median", found.median}, {"p99", found.p99}, {"max", most}};
}

/// A square of instances as wide as the field in total, each rotated.
void addInstances(render::Grass& grass, const std::shared_ptr<render::ResidentField>& field,
                  int count)
{
    const int side = static_cast<int>(std::lround(std::ceil(std::sqrt(double(count)))));
    const double step = double(field->content().size().x) / side;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place((i % side - 0.5 * (side - 1)) * step, 0.0,
                               (i / side - 0.5 * (side - 1)) * step);
        const glm::dquat turned =
            glm::angleAxis(glm::radians(90.0) * (i % 4), glm::dvec3(0.0, 1.0, 0.0));
        grass.add({field, {.position = place, .rotation = turned, .scale = 1.0 / side}});
    }
}

/// A view of an image as an array of one layer.
gpu::ImageView arrayView(const gpu::DeviceContext& context, const gpu::Image& image)
{
    VkImageViewCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    create.image = image.get();
    create.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    create.format = image.format();
    create.subresourceRange = {image.aspect(), 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    gpu::check(context.vk.CreateImageView(context.device, &create, context.allocation, &view),
               "vkCreateImageView");
    return {context, view};
}

/// Lamps above the field, each of which reaches all of it.
std::vector<render::HostLamp> lampsOver(const render::ResidentField& field, int count)
{
    const double width = double(field.content().size().x);
    std::vector<render::HostLamp> lamps;
    for (int i = 0; i < count; ++i)
        lamps.push_back(
            {.position = {(i % 4 - 1.5) * 0.25 * width, 2.0, (i / 4 - 1.5) * 0.25 * width},
             .range = static_cast<float>(2.0 * width)});
    return lamps;
}

/// The host's opaque scene: a sky in the colour, and its far depth. Leaves both for storage.
void recordScene(VkCommandBuffer commands, const gpu::Image& color, const gpu::Image& depth)
{
    for (const gpu::Image* image : {&color, &depth})
        gpu::transition(commands, *image, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
    {
        const gpu::ColorAttachment targets[]{
            {.view = color.view(), .clear = std::array{0.3f, 0.5f, 0.8f, 1.0f}},
            {.view = depth.view(), .clear = std::array{0.0f, 0.0f, 0.0f, 0.0f}}};
        const gpu::RenderingScope scope(commands, extent, targets);
    }
    for (const gpu::Image* image : {&color, &depth})
        gpu::transition(commands, *image, gpu::ImageUse::colorTarget, gpu::ImageUse::storage);
}

void run(const Options& options)
{
    const gpu::Instance instance;
    const gpu::Device device(instance);
    const gpu::DeviceContext& context = device.context();
    const auto mapped = std::make_shared<const field::MappedField>(field::readField(options.field));
    render::FieldBudget budget{.bytes = std::uint64_t(options.numbers.at("budget")) << 20,
                               .instances =
                                   static_cast<std::uint32_t>(options.numbers.at("instances")),
                               .framesInFlight = slots,
                               .sownBytes = std::uint64_t(options.numbers.at("sown")) << 20,
                               .sowThreads = static_cast<std::uint32_t>(options.numbers.at("sow"))};
    if (options.numbers.at("shaders") != 0)
        budget.sowsOnDevice = true;
    const auto lawn = std::make_shared<render::ResidentField>(context, mapped, budget);
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();
    const auto samples = static_cast<std::uint32_t>(options.numbers.at("samples"));
    const auto image = [&](const char* name, VkFormat format, VkImageUsageFlags usage) {
        return gpu::Image(
            context,
            {.name = name, .format = format, .extent = extent, .usage = usage, .samples = samples});
    };
    const gpu::Image color = image("color", colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    const gpu::Image depth =
        image("depth", VK_FORMAT_D32_SFLOAT,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    // What grass is stored into: the host's resolved colour, and a depth for its later passes.
    const int store = options.numbers.at("store");
    const gpu::Image resolved(context, {.name = "resolved",
                                        .format = colorFormat,
                                        .extent = extent,
                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                        .storedAs = VK_FORMAT_R8G8B8A8_UNORM});
    const gpu::Image storedDepth(
        context, {.name = "stored depth",
                  .format = VK_FORMAT_R32_SFLOAT,
                  .extent = extent,
                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT});
    render::Grass grass(context, {.framesInFlight = slots});
    addInstances(grass, lawn, options.numbers.at("instances"));
    const render::BladeTarget target(context,
                                     {.colorFormats = {colorFormat},
                                      .samples = samples,
                                      .keepsRadiance = options.numbers.at("radiance") != 0});

    std::ifstream file(options.scene);
    const nlohmann::json scene = nlohmann::json::parse(file);
    render::FrameSettings settings = render::FrameSettings::of(mapped->view());
    if (scene.contains("draw") && scene.at("draw").at(0) == "--draw-distance")
        settings.environment.drawDistance = std::stof(scene.at("draw").at(1).get<std::string>());
    // A map of the whole field, of nothing between it and the sun.
    const gpu::Image map(context, {.name = "shadow map",
                                   .format = VK_FORMAT_D32_SFLOAT,
                                   .extent = {2048, 2048},
                                   .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                            VK_IMAGE_USAGE_SAMPLED_BIT});
    const gpu::ImageView mapView = arrayView(context, map);
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
        gpu::transition(commands, map, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
        {
            const gpu::RenderingScope scope(
                commands, map.extent(), {},
                gpu::DepthAttachment{.view = map.view(), .clear = 0.0f});
        }
        gpu::transition(commands, map, gpu::ImageUse::depthTarget, gpu::ImageUse::sampled);
    });
    const double reach = double(glm::length(lawn->content().size()));
    const glm::dmat4 worldToShadow[]{glm::orthoRH_ZO(-reach, reach, -reach, reach, reach, -reach) *
                                     glm::lookAt(glm::dvec3(0.0),
                                                 -glm::dvec3(settings.sunDirection),
                                                 glm::dvec3(0.0, 0.0, 1.0))};
    const std::vector<render::HostLamp> lamps = lampsOver(*lawn, options.numbers.at("lamps"));
    render::HostLight light{.lamps = lamps};
    if (options.numbers.at("ambient") != 0)
        light.ambient = render::HostAmbient::constant(glm::vec3(0.5f));
    const bool flies = options.numbers.at("fly") != 0;
    const int speed = options.numbers.at("speed");
    bench::Circle circle(mapped->view(), speed);
    const auto firstCamera = [&] {
        if (speed > 0)
            return circle.at(0.0);
        return flies ? scene.at("moving")[0] : scene.at("camera");
    };
    render::HostView view{.worldToClip = worldToClip(firstCamera()),
                          .size = {extent.width, extent.height},
                          .samples = samples,
                          .geometry = options.geometry,
                          .depth = render::HostDepth{.view = depth.view(), .samples = samples}};
    if (options.numbers.at("shadow") != 0)
        view.shadow = render::HostShadow{.view = mapView.get(), .worldToShadow = worldToShadow};

    if (store != 0)
        view.stored =
            render::StoredPicture{.color = resolved.storedView(),
                                  .format = VK_FORMAT_R8G8B8A8_UNORM,
                                  .isSrgb = true,
                                  .keepsRadiance = false,
                                  .depth = store > 1 ? storedDepth.view() : VK_NULL_HANDLE,
                                  .size = {extent.width, extent.height}};

    gpu::FrameRing ring(context, slots);
    gpu::Timestamps times(context, {.slots = slots});
    std::vector<double> begins;   // Grass::begin
    std::vector<double> records;  // all that is recorded after it
    std::vector<double> recorded; // both
    std::vector<double> frames;   // from begin to begin, without statistics
    bench::Flight flight;
    double lastBegin = 0.0;
    double counting = 0.0; // time of statistics since then
    const auto begun = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    };
    // Warm up half a second to reach the device's clock, and until what is streamed of the first
    // view is there; then measure.
    int counted = 0;
    double started = 0.0;
    for (int frame = 0; counted < options.numbers.at("frames"); ++frame) {
        if (counted == 0 && (seconds() < 0.5 || !grass.streamingStats().isSettled))
            times.clearHistory();
        else
            ++counted;
        if (counted == 1)
            started = seconds();
        const double flown =
            options.numbers.at("clock") != 0 ? seconds() - started : counted / 60.0;
        if (speed > 0 && counted > 0)
            view.worldToClip = worldToClip(circle.at(flown));
        else if (flies && counted > 0)
            view.worldToClip = worldToClip(cameraAt(scene.at("moving"), flown));
        const gpu::FrameRing::Frame recording = ring.begin();
        if (counted > 1)
            frames.push_back(1e3 * (seconds() - lastBegin - counting));
        lastBegin = seconds();
        counting = 0.0;
        VkCommandBuffer commands = recording.commands;
        times.beginFrame(commands, recording.slot);
        gpu::transition(commands, depth, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
        {
            const gpu::RenderingScope scope(
                commands, extent, {}, gpu::DepthAttachment{.view = depth.view(), .clear = 0.0f});
        }
        gpu::transition(commands, depth, gpu::ImageUse::depthTarget, gpu::ImageUse::sampled);
        if (store != 0)
            recordScene(commands, resolved, storedDepth);
        const double before = seconds();
        grass.begin(
            recording.slot,
            {.time = frame / 60.0, .views = {&view, 1}, .settings = settings, .light = light});
        const double hasBegun = seconds();
        const std::uint32_t all = times.begin(commands, "grass");
        const auto timed = [&](const char* name, const auto& record) {
            const gpu::TimedScope scope(times, context, commands, name);
            record();
        };
        timed("update", [&] { grass.recordUpdate(commands); });
        timed("cull", [&] { grass.recordCull(commands, 0); });
        timed("raster", [&] { grass.recordRaster(commands, 0); });
        const bool isDrawn = grass.whyNotStored(0) != nullptr;
        if (isDrawn) {
            gpu::transition(commands, depth, gpu::ImageUse::sampled, gpu::ImageUse::depthTarget);
            gpu::transition(commands, color, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        }
        timed("draw", [&] {
            if (!isDrawn)
                return;
            const gpu::ColorAttachment attachment{.view = color.view(),
                                                  .clear = std::array{0.3f, 0.5f, 0.8f, 1.0f}};
            const gpu::RenderingScope scope(
                commands, extent, {&attachment, 1},
                gpu::DepthAttachment{.view = depth.view(), .clear = std::nullopt});
            grass.recordDraw(commands, 0, target);
        });
        times.end(commands, all);
        const double end = seconds();
        ring.submit(recording);
        if (counted == 0)
            continue;
        begins.push_back(1e3 * (hasBegun - before));
        records.push_back(1e3 * (end - hasBegun));
        recorded.push_back(1e3 * (end - before));
        const double atStats = seconds();
        const render::StreamingStats stats = grass.streamingStats();
        flight.add(stats);
        if (options.numbers.at("each") != 0)
            std::printf("frame %d: begin %.3f ms, record %.3f ms, copied %llu bytes, missing %llu "
                        "of %llu pages, nearest at %.1f m, thinning %.2f, drawn %llu\n",
                        counted, begins.back(), records.back(),
                        static_cast<unsigned long long>(stats.copiedBytes),
                        static_cast<unsigned long long>(stats.missingPages),
                        static_cast<unsigned long long>(stats.wantedPages),
                        double(stats.nearestMissing), double(stats.thinning),
                        static_cast<unsigned long long>(grass.stats(0, recording.slot).drawn));
        counting = seconds() - atStats;
    }
    ring.finish();
    times.collect();
    nlohmann::json out{{"device", context.name},
                       {"samples", samples},
                       {"instances", options.numbers.at("instances")},
                       {"geometry", grass.whyTessellated(0) == nullptr ? "raster" : "tessellation"},
                       {"stored", grass.whyNotStored(0) == nullptr},
                       {"drawn", grass.stats(0, 0).drawn},
                       {"device_bytes", grass.deviceBytes()},
                       {"field_bytes", lawn->deviceBytes()},
                       {"cpu_ms", gpu::statisticsOf(recorded).median},
                       {"cpu_spread_ms", spreadOf(recorded)},
                       {"cpu_begin_spread_ms", spreadOf(begins)},
                       {"cpu_record_spread_ms", spreadOf(records)},
                       {"frame_spread_ms", spreadOf(frames)}};
    for (const std::string& name : times.names()) {
        out["gpu_ms"][name] = times.statistics(name).median;
        out["gpu_p99_ms"][name] = times.statistics(name).p99;
    }
    if (lawn->isStreamed() || lawn->isSown()) {
        const render::StreamingStats stats = grass.streamingStats();
        out["streaming"] = {{"settled_after_s", started},
                            {"resident_blades", stats.residentBlades},
                            {"pages", stats.pages},
                            {"places", stats.places},
                            {"resident_pages", stats.residentPages},
                            {"wanted_pages", stats.wantedPages},
                            {"missing_pages", stats.missingPages},
                            {"flight", flight.toJson()},
                            {"thinning", stats.thinning}};
    }
    std::puts(out.dump().c_str());
}

} // namespace
} // namespace sward

int main(int argc, char** argv)
try {
    if (argc < 3) {
        std::fputs(
            "usage: sward_host_bench FIELD.sward SCENE.json [raster|tessellation] [samples=N] "
            "[instances=N] [frames=N] [lamps=N] [ambient=1] [shadow=1] [budget=MIB] [fly=1] "
            "[speed=M/S] [each=1] [store=1] [clock=1] [sow=THREADS] [sown=MIB]\n",
            stderr);
        return 1;
    }
    sward::run(sward::optionsOf(argc, argv));
} catch (const std::exception& error) {
    std::fprintf(stderr, "sward_host_bench: %s\n", error.what());
    return 4;
}
