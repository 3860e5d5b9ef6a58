#include "render/viewer/field_renderer.h"

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/context/check.h"
#include "gpu/device/device.h"
#include "gpu/memory/upload.h"
#include "gpu/recording/barrier.h"
#include "render/cull/cull_view.h"
#include "render/cull/pass_scope.h"
#include "render/frame/frame_time.h"
#include "render/viewer/blade_dump.h"
#include "render/viewer/exposure.h"
#include "render/viewer/field_renderer_parts.h"
#include "render/viewer/field_target.h"
#include "render/viewer/geometry_choice.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

FieldBuffers::Records recordsFor(const gpu::DeviceContext& context, Geometry geometry,
                                 const FieldRenderer::Settings& wanted)
{
    return {.list = geometry == Geometry::tessellation || wanted.recordCullResults,
            .cullResults = wanted.recordCullResults,
            .roundPatches = wanted.roundPatches,
            .walkStart = context.isCpu() ? shared::walkStart : shared::walkStartOfGpu};
}

constexpr std::uint64_t ofColliders =
    std::uint64_t(shared::maxColliders) * shared::colliderTriangles;
constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();

/// Throws Error{unsupported} if the visibility cannot number all blades and triangles.
void expectNumbers(const gpu::DeviceContext& context, std::uint64_t blades, std::uint64_t triangles)
{
    if (blades + triangles + ofColliders >= most)
        fail(ErrorKind::unsupported,
             "{} cannot draw {} blades on {} triangles of ground by compute shaders: there are {} "
             "numbers for both; --geometry tessellation needs none",
             context.name, blades, triangles, most - ofColliders);
}

/// Uploads the field's data and waits for it.
template <typename T, typename... Arguments>
T uploaded(const gpu::DeviceContext& context, const Arguments&... arguments)
{
    gpu::Uploader uploader(context);
    T result(context, uploader, arguments...);
    uploader.finish();
    return result;
}

template <typename T, typename... Arguments>
std::optional<T> madeIf(bool isWanted, const Arguments&... arguments)
{
    return isWanted ? std::optional<T>(std::in_place, arguments...) : std::optional<T>();
}

} // namespace

FieldRenderer::Parts::Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field,
                            const Settings& wanted)
    : context(checked(deviceContext, field, wanted))
    , settings(wanted)
    , geometry(chooseGeometry(context, wanted))
    , shaders(wanted.shaders.empty() ? embedded::shaders() : wanted.shaders)
    , targetSettings(targetFor(context, field, wanted))
    , ground(uploaded<GroundBuffers>(context, *field.ground))
    , cover(uploaded<GrassCover>(context, field, wanted.isEditable))
    , sunShadow(context, shaders, ground.box(), wanted.deviceBytes == 0)
    , pyramid(context, shaders, wanted.samples, geometry == Geometry::tessellation)
    , attachments(madeIf<Attachments>(geometry == Geometry::tessellation, context, targetSettings))
    , opaque(madeIf<OpaquePass>(geometry == Geometry::tessellation, context, shaders,
                                targetSettings, ground))
    , tessellated(madeIf<TessellatedPass>(geometry == Geometry::tessellation, context, shaders,
                                          targetSettings))
    , opaqueRaster(madeIf<OpaqueRasterPass>(geometry == Geometry::raster, context, shaders, ground,
                                            targetSettings))
    , raster(madeIf<ViewerRaster>(geometry == Geometry::raster, context, targetSettings,
                                  static_cast<std::uint32_t>(field.blades.size())))
    , resolve(madeIf<ResolvePass>(geometry == Geometry::raster, context, shaders, targetSettings,
                                  wanted.framesInFlight))
    , plan(planWithin(field))
    , edited(editedOf(field))
    , blades(context, shaders, uploaded<FieldBuffers>(context, field, plan.records, edited.get()),
             wanted.testsSmallBlades.value_or(!context.isCpu()))
    , shape{field.origin, field.bounds(), blades.buffers().bladeSize(), chosenExposure(field)}
{
    if (raster)
        expectNumbers(context, field.blades.size(), ground.triangleCount());
    if (edited) {
        blades.expectEdits(shaders, std::move(edited), cover, wanted.framesInFlight);
        if (raster)
            raster->expectBlades(blades.buffers().baked().placeCount(), blades.replaced());
    }
    if (plan.records.pages > 0)
        streaming.emplace(context, shaders, field, blades.buffers().baked(), plan.streaming);
    const gpu::UniformSetLayout frameLayout(context, "frame");
    for (std::uint32_t i = 0; i < wanted.framesInFlight; ++i)
        slots.emplace_back(context, frameLayout);
}

FieldRenderer::FieldRenderer(const gpu::Device& device, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(device.context(), field, settings))
{
}

FieldRenderer::FieldRenderer(const gpu::DeviceContext& context, const field::OwnedField& field,
                             const Settings& settings)
    : FieldRenderer(context, field.view(), settings)
{
    if (isStreamed())
        parts_->source = field;
}

FieldRenderer::FieldRenderer(const gpu::DeviceContext& context, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(context, field, settings))
{
}

FieldRenderer::FieldRenderer(FieldRenderer&&) noexcept = default;
FieldRenderer::~FieldRenderer() = default;

/// Pictures are allocated once to measure their memory.
MemoryPlan FieldRenderer::Parts::planWithin(const field::FieldView& field)
{
    const FieldBuffers::Records records = recordsFor(context, geometry, settings);
    if (settings.deviceBytes == 0)
        return {.records = records, .streaming = {}};
    fit(settings.largestTarget);
    return planFor(field, records,
                   {.bytes = settings.deviceBytes,
                    .others = bytesBesideBlades() + (resolve ? resolve->bytesToCopy() : 0),
                    .framesInFlight = settings.framesInFlight,
                    .waitsForDisk = settings.waitsForDisk});
}

std::unique_ptr<EditedField> FieldRenderer::Parts::editedOf(const field::FieldView& field) const
{
    if (!settings.isEditable || plan.records.pages > 0)
        return nullptr;
    const std::uint64_t triangles = geometry == Geometry::raster ? ground.triangleCount() : 0;
    return std::make_unique<EditedField>(
        field, plan.records.walkStart,
        static_cast<std::uint32_t>(most - 1 - std::min(most - 1, triangles + ofColliders)));
}

void FieldRenderer::Parts::fit(glm::uvec2 size)
{
    requireUsage(size.x > 0 && size.y > 0, "a target of {} x {} pixels", size.x, size.y);
    if (size == pictureSize)
        return;
    if (pictureSize != glm::uvec2(0))
        gpu::check(context.vk.DeviceWaitIdle(context.device), "vkDeviceWaitIdle");
    pictureSize = size;
    hasPyramid = false;
    if (raster) {
        const VkExtent2D extent{size.x, size.y};
        pyramid.resize(extent);
        opaqueRaster->resize(extent);
        raster->resize(extent);
        resolve->resize(extent, opaqueRaster->lit());
        return;
    }
    attachments->resize(size);
    pyramid.resize(attachments->depth());
    tessellated->resize(size);
}

/// Streams visible blades in, and raises the thinning to the resident blades.
void FieldRenderer::Parts::stream(shared::Frame& frame, const FrameSettings& wanted,
                                  glm::uvec2 size, std::uint32_t slot)
{
    shared::Eyepoint seen = frame.view;
    if (wanted.cullingCamera)
        seen = cullViewFrom(frame,
                            viewMatrices(*wanted.cullingCamera, shape.origin, size, shape.content))
                   .view;
    streaming->choose({&seen, 1}, slot);
    frame.view.lodThreshold = seen.lodThreshold;
}

void FieldRenderer::Parts::recordStreaming(const gpu::Recording& commands, std::uint32_t slot,
                                           double time) const
{
    gpu::memoryBarrier(commands, gpu::fillAccess, gpu::fillAccess);
    const BladeStates* const states = &blades.buffers().ownStates();
    streaming->record(commands, slot, settledTick(time), {&states, 1});
    gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
}

shared::Frame FieldRenderer::Parts::writeFrame(shared::Frame frame, const FrameSettings& wanted,
                                               double time, std::uint32_t slot)
{
    if (!wanted.colliders.empty())
        blades.expectColliders();
    blades.buffers().describe(frame);
    slots[slot].blades = blades.buffers().bladeCount();
    cover.describe(frame, wanted.thatch);
    if ((frame.view.cullMask & shared::cullOcclusion) != 0 || findsHidden(wanted))
        pyramid.describe(frame);
    const std::vector<shared::Collider> colliders =
        collidersAt(wanted.colliders, shape.origin, time, blades.hasMoved() ? lastTime : time);
    slots[slot].tables.write(shape, wanted, colliders, time, frame);
    lastTime = time;
    frame.updateRate.frame = frameNumber++;
    sunShadow.describe(frame, colliders);
    slots[slot].frame.fill(frame);

    // Create pipelines that a frame needs for the first time.
    blades.prepare(shaders, frame);
    const std::uint32_t debugMode = knownDebugMode(wanted.debug);
    const bool paintsWind = wanted.debug == DebugMode::wind;
    sunShadow.prepare(shaders);
    if (raster) {
        opaqueRaster->prepare(shaders, frame.environment.colliderCount, debugMode);
        const Shading shading{.debugMode = debugMode,
                              .limitsLeafArea = frame.view.maxLeafArea > 0.0f,
                              .hasShadingCache = findsHidden(wanted)};
        raster->prepare(shaders, shading);
        resolve->prepare(shaders, shading);
    } else {
        opaque->prepare(shaders, frame.environment.colliderCount, paintsWind);
        tessellated->prepare(shaders, paintsWind);
    }
    return frame;
}

FramePlace FieldRenderer::Parts::fillCullView(const shared::Frame& frame,
                                              const FrameSettings& wanted, glm::uvec2 size,
                                              std::uint32_t slot)
{
    requireUsage(wanted.debug != DebugMode::reason || settings.recordCullResults,
                 "DebugMode::reason needs FieldRendererSettings::recordCullResults");
    if (wanted.debug == DebugMode::reason)
        slots[slot].listing.fill(listingAll(frame));
    shared::Frame cullView = frame;
    if (wanted.cullingCamera)
        cullView = cullViewFrom(
            frame, viewMatrices(*wanted.cullingCamera, shape.origin, size, shape.content));
    rounds = blades.buffers().roundCount(cullView,
                                         streaming ? streaming->residentPatches()
                                                   : blades.buffers().baked().nonEmptyPatchCount());
    if (!wanted.cullingCamera)
        return slots[slot].frame.place();
    if (!hasPyramid)
        cullView.pyramid = {};
    slots[slot].cullView.fill(cullView);
    return slots[slot].cullView.place();
}

void FieldRenderer::record(VkCommandBuffer buffer, const Target& target, const Camera& camera,
                           const FrameSettings& settings, double time, std::uint32_t slot,
                           gpu::Timestamps* timestamps, glm::vec2 jitter)
{
    Parts& parts = *parts_;
    parts.requireFrame(buffer, settings, time, slot);
    const gpu::Recording commands(parts.context, buffer);
    requireUsage(target.image != VK_NULL_HANDLE && target.view != VK_NULL_HANDLE,
                 "FieldRenderer::Target: its image or its view is null");
    const gpu::LabelScope label(parts.context, commands, "field");

    const bool isPart = target.whole != glm::uvec2(0);
    requireUsage(!isPart || !parts.streaming, "a streamed field's picture is drawn as a whole");
    const glm::uvec2 whole = isPart ? target.whole : target.size;
    ViewMatrices view =
        viewMatrices(camera, parts.shape.origin, whole, parts.shape.content, jitter);
    if (isPart)
        view = partOf(view, whole, target.first, target.size);
    parts.fit(target.size);
    shared::Frame wanted = frameOf(parts.shape, view, settings, time, parts.settings.samples);
    if (parts.streaming)
        parts.stream(wanted, settings, target.size, slot);
    const shared::Frame frame = parts.writeFrame(wanted, settings, time, slot);
    const FramePlace cullView = parts.fillCullView(frame, settings, whole, slot);
    {
        const DispatchScope scope(parts.context, commands, timestamps, "sun shadow");
        parts.sunShadow.record(commands, parts.ground, parts.slots[slot].frame.place().address);
    }

    const bool looksForHidden = (settings.cullMask & shared::cullOcclusion) != 0;
    const bool findsReasons = settings.debug == DebugMode::reason;
    const bool findsHidden = parts.findsHidden(settings);
    const ViewerRaster::Input raster{
        .field = &parts.blades.buffers(),
        .frame = parts.slots[slot].frame.place(),
        .cullView = findsReasons ? parts.slots[slot].listing.place() : cullView,
        .firstBlade = parts.raster ? parts.opaqueRaster->firstBlade() : 1,
        .hasTwoPasses = findsHidden};

    parts.blades.begin(commands, time, slot);
    // Blades hidden by the ground are neither moved nor drawn.
    if (parts.raster)
        parts.rasterOpaque(commands, slot, timestamps);
    else
        parts.drawOpaque(commands, target, slot, timestamps);
    if (!settings.cullingCamera) {
        if (looksForHidden && parts.raster)
            parts.seeWhatIsHidden(commands, raster, timestamps);
        else if (looksForHidden)
            parts.seeWhatIsHidden(commands, slot, timestamps);
        parts.hasPyramid = looksForHidden;
    }
    if (parts.streaming)
        parts.recordStreaming(commands, slot, time);
    parts.blades.findVisiblePatches(commands, cullView.address, timestamps);
    if (findsReasons) {
        // Draw all blades in the colours of their cull results.
        parts.blades.moveAndList(commands, cullView, 0, {}, timestamps);
        parts.slots[slot].recordCounts(commands, parts.blades.buffers().draw());
        parts.blades.beginAgain(commands);
        parts.blades.findVisiblePatches(commands, raster.cullView.address, nullptr);
    }
    if (parts.raster)
        parts.rasterBlades(commands, raster, timestamps);
    else
        parts.blades.moveAndList(commands, raster.cullView, 0, {}, timestamps);

    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    if (!findsReasons)
        parts.slots[slot].recordCounts(commands, parts.blades.buffers().draw());
    if (parts.raster) {
        parts.makePicture(commands, target, slot, raster, timestamps);
    } else {
        parts.drawBlades(commands, target, slot, timestamps);
        parts.tessellated->finish(commands, target.view);
    }
}

void FieldRenderer::recordUpdateOnly(VkCommandBuffer buffer, const FrameSettings& settings,
                                     double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    parts.requireFrame(buffer, settings, time, slot);
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "field/update only");
    parts.writeFrame(frameOf(parts.shape, ViewMatrices{}, settings, time, parts.settings.samples),
                     settings, time, slot);
    parts.blades.begin(commands, time, slot);
    parts.blades.moveAll(commands, parts.slots[slot].frame.place());
}

bool FieldRenderer::recordStreaming(VkCommandBuffer buffer, glm::uvec2 size, const Camera& camera,
                                    const FrameSettings& settings, double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    parts.requireFrame(buffer, settings, time, slot);
    const gpu::Recording commands(parts.context, buffer);
    if (!parts.streaming)
        return true;
    const gpu::LabelScope label(parts.context, commands, "field/streaming");
    shared::Frame frame =
        frameOf(parts.shape, viewMatrices(camera, parts.shape.origin, size, parts.shape.content),
                settings, time, parts.settings.samples);
    parts.stream(frame, settings, size, slot);
    if (!parts.blades.hasMoved())
        parts.lastTime = time;
    parts.blades.begin(commands, time, slot);
    parts.recordStreaming(commands, slot, time);
    return parts.streaming->isSettled();
}

std::optional<VkSemaphoreSubmitInfo> FieldRenderer::copied() const
{
    return parts_->streaming ? parts_->streaming->copied() : std::nullopt;
}

FrameStats FieldRenderer::stats(std::uint32_t slot) const
{
    requireUsage(slot < parts_->slots.size(), "slot {} of {}", slot, parts_->slots.size());
    const FrameSlot& frame = parts_->slots[slot];
    return frame.counts(parts_->streaming ? parts_->streaming->residentBlades(slot) : frame.blades);
}

std::vector<FieldRenderer::BladeRecord>
FieldRenderer::dumpBlades(const field::FieldView& field) const
{
    requireUsage(field.blades.size() == parts_->blades.buffers().bladeCount(),
                 "a field of {} blades; that of the renderer has {}", field.blades.size(),
                 parts_->blades.buffers().bladeCount());
    if (parts_->streaming)
        fail(ErrorKind::unsupported,
             "not all of the field's {} blades are in device memory; "
             "only those in memory have a state",
             field.blades.size());
    std::vector<std::uint32_t> places;
    if (const EditedField* const edited = parts_->blades.edited())
        places = edited->placesOf(field);
    return readBlades(parts_->context, parts_->blades.buffers(), field, places);
}

std::vector<FieldRenderer::BladeRecord> FieldRenderer::dumpPatch(const field::FieldView& field,
                                                                 std::uint32_t patch) const
{
    requireUsage(patch < field.patches.size(), "patch {} of {}", patch, field.patches.size());
    const shared::Patch& cell = field.patches[patch];
    std::vector<BladePart> parts{{cell.firstBlade, cell.bladeCount}};
    if (parts_->streaming)
        parts = parts_->streaming->partsOf(cell);
    if (const EditedField* const edited = parts_->blades.edited(); edited && cell.bladeCount > 0)
        parts = {{edited->placesOf(field)[cell.firstBlade], cell.bladeCount}};
    return readPatch(parts_->context, parts_->blades.buffers(), field, patch, parts);
}

Geometry FieldRenderer::geometry() const
{
    return parts_->geometry;
}

const char* FieldRenderer::geometryReason() const
{
    return reasonForGeometry(parts_->context, parts_->settings);
}

std::size_t FieldRenderer::Parts::bytesBesideBlades() const
{
    const std::size_t pictures = raster ? raster->bytes() + opaqueRaster->bytes() + resolve->bytes()
                                        : attachments->bytes() + opaque->bytes();
    return ground.bytes() + cover.bytes() + sunShadow.bytes() + pyramid.bytes() + pictures +
           settings.framesInFlight * FrameSlot::bytes();
}

std::size_t FieldRenderer::deviceBytes() const
{
    return parts_->blades.buffers().bytes() + parts_->bytesBesideBlades() +
           (parts_->streaming ? parts_->streaming->bytes() : 0);
}

bool FieldRenderer::isStreamed() const
{
    return parts_->streaming.has_value();
}

Aabb FieldRenderer::content() const
{
    return parts_->shape.content;
}

} // namespace sward::render
