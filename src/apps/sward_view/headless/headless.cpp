#include "apps/sward_view/headless/headless.h"

#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/headless/picture_target.h"
#include "apps/sward_view/picture/picture_mean.h"
#include "apps/sward_view/scene/camera_file.h"
#include "core/error.h"
#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "render/frame/frame_time.h"

#include <algorithm>
#include <chrono>
#include <cstring>

namespace sward::view {
namespace {

constexpr std::uint32_t slot = 0; ///< one frame at a time

constexpr std::uint32_t referencePictures = 256;

/// Segments of a blade in a reference picture unless set: a fixed value, because tessellation is
/// level of detail too.
constexpr int referenceSegments = 16;

// Adds two series frame by frame; both have the same frames.
std::vector<double> sumOf(std::vector<double> first, const std::vector<double>& second)
{
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        first[i] += second[i];
    return first;
}

std::vector<field::MappedField> readAll(const std::vector<std::string>& names)
{
    std::vector<field::MappedField> files;
    for (const std::string& name : names) {
        apps::requireField(name);
        files.push_back(field::readField(name));
    }
    return files;
}

std::vector<field::Member> membersOf(const std::vector<field::MappedField>& files,
                                     const std::vector<std::string>& names)
{
    std::vector<field::Member> members;
    for (std::size_t i = 0; i < files.size(); ++i)
        members.push_back({files[i].view(), names[i]});
    return members;
}

render::FieldRendererSettings settingsFor(const FrameOptions& options, Headless::Wanted wanted,
                                          VkFormat format)
{
    render::FieldRendererSettings settings = rendererFor(options, format, wanted.radiance);
    settings.recordCullResults = settings.recordCullResults || wanted.blades;
    settings.keepsMotion = (wanted.layers & render::flowLayers) != 0;
    return settings;
}

// Numbers of the fields that patches come from, for the layers of several fields.
std::vector<std::uint32_t> numbersOf(const FieldGroup& fields, bool areWanted)
{
    if (!areWanted || fields.members().size() == 1)
        return {};
    if (fields.members().size() > render::LayerId::maxFields)
        fail(ErrorKind::usage, "--layers: {} fields are drawn together, more than {}",
             fields.members().size(), render::LayerId::maxFields);
    return fields.memberOfPatches();
}

float aspectOf(glm::uvec2 size)
{
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

} // namespace

Headless::Headless(const FrameOptions& options, Wanted wanted)
    : options_(options)
    , files_(readAll(options.fields))
    , fields_(membersOf(files_, options.fields))
    , numberOfPatch_(numbersOf(fields_, wanted.layers != 0))
    , settings_(options.settingsFor(fields_.view()))
    , camera_(options.sceneCamera
                  ? readCameraPath(options.sceneCamera->text, options.sceneCamera->place,
                                   groundUpOf(fields_.view()))
                  : chooseCamera(options.camera, fields_.view(), aspectOf(options.size),
                                 settings_.sunDirection))
    , instance_(createInstance(options.validation))
    , device_(instance_, {.selection = options.device})
    , samples_(options.samples.value_or(4))
    , target_(device_.context(),
              targetFor(device_.context(), options.size, options.geometry, wanted.radiance))
    , renderer_(device_, fields_.view(), settingsFor(options, wanted, target_.format()))
    , timestamps_(device_.context(), {.slots = 1})
    , ring_(device_.context(), 1)
{
    // Cull results need the motion of every blade.
    if (wanted.blades)
        settings_.leavesThinned = false;
    if (wanted.radiance)
        settings_.exposure = 1.0f;
}

void Headless::requireTime(const FrameOptions& options, std::uint64_t last)
{
    const double time = static_cast<double>(last) * options.fixedStep;
    if (time > render::longestTime)
        fail(ErrorKind::usage, "--fixed-dt: frame {} would be at {} s; at most {:.0f} s, 272 years",
             last, time, render::longestTime);
}

double Headless::timeOf(std::uint64_t frame) const
{
    return static_cast<double>(frame) * options_.fixedStep;
}

void Headless::skip(std::uint64_t frame)
{
    apps::throwIfInterrupted("simulation");
    const gpu::FrameRing::Frame commands = ring_.begin();
    renderer_.recordUpdateOnly(commands.commands, settings_, timeOf(frame), slot);
    ring_.submit(commands);
    ring_.finish();
}

void Headless::move(const render::FrameSettings& settings, double time)
{
    apps::throwIfInterrupted("simulation");
    const gpu::FrameRing::Frame commands = ring_.begin();
    timestamps_.beginFrame(commands.commands, slot);
    {
        const gpu::TimedScope move(timestamps_, device_.context(), commands.commands, "move");
        renderer_.recordUpdateOnly(commands.commands, settings, time, slot);
    }
    ring_.submit(commands);
    ring_.finish();
}

void Headless::stream(std::uint64_t frame)
{
    for (bool isThere = false; !isThere;) {
        apps::throwIfInterrupted("streaming");
        const gpu::FrameRing::Frame commands = ring_.begin();
        isThere =
            renderer_.recordStreaming(commands.commands, options_.size, camera_.at(timeOf(frame)),
                                      settings_, timeOf(frame), slot);
        ring_.submit(commands);
        ring_.finish();
    }
}

void Headless::draw(std::uint64_t frame, render::LayerMask layers)
{
    record(shotAt(timeOf(frame)), glm::vec2(0.0f), layers);
}

void Headless::draw(const Shot& shot, render::LayerMask layers)
{
    record(shot, glm::vec2(0.0f), layers);
}

/// A frame of the path. The frame before may have been drawn or only simulated.
Headless::Shot Headless::shotAt(double time) const
{
    return {.camera = camera_.at(time),
            .before = camera_.at(std::max(time - options_.fixedStep, 0.0)),
            .settings = settings_,
            .time = time};
}

render::LayerWords Headless::layerWords() const
{
    return renderer_.layerWords(fields_.view(), slot);
}

render::FrameLayers Headless::layersOf(const render::LayerWords& words) const
{
    return render::layersOf(words, fields_.view(), numberOfPatch_);
}

void Headless::record(const Shot& shot, glm::vec2 jitter, render::LayerMask layers)
{
    apps::throwIfInterrupted("drawing");
    const gpu::FrameRing::Frame frame = ring_.begin();
    timestamps_.beginFrame(frame.commands, slot);
    gpu::transition(frame.commands, target_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);

    const auto begin = std::chrono::steady_clock::now();
    {
        const gpu::TimedScope total(timestamps_, device_.context(), frame.commands, "total");
        renderer_.record(frame.commands,
                         {.image = target_.get(),
                          .view = target_.view(),
                          .size = options_.size,
                          .stored = target_.storedView(),
                          .layers = layers,
                          .cameraBefore = layers != 0 ? &shot.before : nullptr},
                         shot.camera, shot.settings, shot.time, slot, &timestamps_, jitter);
    }
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - begin;
    recordTimes_.push_back(spent.count());

    ring_.submit(frame);
    ring_.finish();
}

Picture Headless::picture()
{
    const std::span<const std::byte> bytes =
        gpu::readImage(device_.context(), target_, gpu::ImageUse::colorTarget, staging_);
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return {options_.size, {first, first + bytes.size()}};
}

Radiance Headless::radiance()
{
    const std::span<const std::byte> bytes =
        gpu::readImage(device_.context(), target_, gpu::ImageUse::colorTarget, staging_);
    const auto* first = reinterpret_cast<const std::uint16_t*>(bytes.data());
    return {options_.size, {first, first + bytes.size() / sizeof *first}};
}

void Headless::drawReference(std::uint64_t frame, const std::function<void()>& use)
{
    render::FrameSettings everything = settings_;
    everything.cullMask = 0;
    everything.levelOfDetail = false;
    if (everything.tessellationLevel == 0)
        everything.tessellationLevel = referenceSegments;
    for (std::uint32_t i = 0; i < referencePictures; ++i) {
        Shot shot = shotAt(timeOf(frame));
        shot.settings = everything;
        record(shot, subpixelOffset(i));
        use();
    }
}

Picture Headless::reference(std::uint64_t frame)
{
    PictureMean sum(options_.size);
    drawReference(frame, [&] { sum.add(picture()); });
    return sum.mean(referencePictures);
}

Radiance Headless::referenceRadiance(std::uint64_t frame)
{
    RadianceMean sum(options_.size);
    drawReference(frame, [&] { sum.add(radiance()); });
    return sum.mean();
}

void Headless::forgetTimes()
{
    timestamps_.collect();
    timestamps_.clearHistory();
    recordTimes_.clear();
}

double Headless::takeDeviceTime()
{
    timestamps_.collect();
    double sum = 0.0;
    for (const char* name : {"total", "move"})
        for (const double time : timestamps_.history(name))
            sum += time;
    timestamps_.clearHistory();
    return sum;
}

std::string Headless::deviceName() const
{
    return device_.context().name + " (" + device_.context().driver + ")";
}

RunStats Headless::stats()
{
    timestamps_.collect();
    RunStats stats;
    stats.device = device_.context().name;
    stats.driver = device_.context().driver;
    stats.size = options_.size;
    stats.samples = samples_;
    stats.geometry = render::nameOf(renderer_.geometry());
    stats.geometryReason = renderer_.geometryReason();
    stats.blades = renderer_.stats(slot);
    for (const std::string& name : timestamps_.names())
        stats.gpuTimes[name] = timestamps_.statistics(name);
    std::vector<double> grass = timestamps_.history("update");
    for (const char* pass : {"cull", "pyramid", "blades", "shadow", "resolve"})
        grass = sumOf(std::move(grass), timestamps_.history(pass));
    stats.gpuTimes["grass"] = gpu::statisticsOf(grass);
    stats.recordTime = gpu::statisticsOf(recordTimes_);
    stats.deviceBytes = renderer_.deviceBytes();
    stats.validationMessages = instance_.validationLog().count();
    return stats;
}

std::vector<render::FieldRenderer::BladeRecord> Headless::blades() const
{
    return renderer_.dumpBlades(fields_.view());
}

} // namespace sward::view
