#include "render/viewer/field_renderer.h"

#include "core/error.h"
#include "gpu/context/check.h"
#include "gpu/device/device.h"
#include "gpu/memory/upload.h"
#include "render/cull/pass_scope.h"
#include "render/frame/frame.h"
#include "render/frame/frame_time.h"
#include "render/frame/shadow_box.h"
#include "render/sowing/sown_memory.h"
#include "render/sowing/sown_view.h"
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

namespace sward::render {
namespace {

BladeRecords recordsFor(Geometry geometry, const FieldRenderer::Settings& wanted)
{
    return {.list = geometry == Geometry::tessellation || wanted.recordCullResults,
            .cullResults = wanted.recordCullResults,
            .roundPatches = wanted.roundPatches};
}

Grass::Settings grassSettings(const FieldRenderer::Settings& wanted)
{
    return {.framesInFlight = wanted.framesInFlight,
            .maxViews = 1,
            .keepsMotion = wanted.keepsMotion,
            .rastersForCpu = wanted.rastersForCpu};
}

PlacedField::Settings bladeSettings(const FieldRenderer::Settings& wanted)
{
    return {.framesInFlight = wanted.framesInFlight,
            .maxViews = 1,
            .keepsMotion = wanted.keepsMotion,
            .keepsCullResults = wanted.recordCullResults};
}

/// A blade's part of the list of visible blades, unless its record has that already [bytes].
std::uint64_t bytesOfSownList(const BladeRecords& records)
{
    return records.list ? 0 : sizeof(shared::VisibleBlade);
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

/// Against a field's gravity; 0 for a planet, which has no level ground.
glm::vec3 levelUpOf(const field::FieldView& field)
{
    const field::Defaults& defaults = *field.defaults;
    const float length = glm::length(defaults.gravityDirection);
    return defaults.attractorBlend > 0.0f || !(length > 0.0f) ? glm::vec3(0.0f)
                                                              : -defaults.gravityDirection / length;
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

FieldRenderer::Parts::Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& view,
                            const Settings& wanted)
    : settings(wanted)
    , geometry(chooseGeometry(checked(deviceContext, view, wanted), wanted))
    , recorder(deviceContext, grassSettings(wanted),
               {.shaders = wanted.shaders,
                .testsSmall = wanted.testsSmallBlades.value_or(!deviceContext.isCpu())})
    , context(recorder.context)
    , targetSettings(targetFor(context, view, wanted))
    , ground(uploaded<GroundBuffers>(context, *view.ground))
    , sunShadow(context, recorder.shaders, ground.box(), wanted.deviceBytes == 0)
    , floorUp(levelUpOf(view))
    , floorPlane(floorUp != glm::vec3(0.0f) ? floorPlaneOf(*view.ground, floorUp)
                                            : shared::FloorPlane{})
    , attachments(madeIf<Attachments>(geometry == Geometry::tessellation, context, targetSettings))
    , opaque(madeIf<OpaquePass>(geometry == Geometry::tessellation, context, recorder.shaders,
                                targetSettings, ground))
    , tessellated(madeIf<TessellatedPass>(geometry == Geometry::tessellation, context,
                                          recorder.shaders, targetSettings))
    , opaqueRaster(madeIf<OpaqueRasterPass>(geometry == Geometry::raster, context, recorder.shaders,
                                            ground, targetSettings))
    , resolve(madeIf<ResolvePass>(geometry == Geometry::raster, context, recorder.shaders,
                                  targetSettings, wanted.framesInFlight))
    , layer{.isBgr = wanted.colorFormat == VK_FORMAT_B8G8R8A8_SRGB}
    , records(recordsFor(geometry, wanted))
    , field(uploadedField(view))
{
    if (geometry == Geometry::raster)
        expectNumbers(context, view.blades.size(), ground.triangleCount());
    PlacedField::Settings own = bladeSettings(wanted);
    own.roundPatches = roundPatchesOf(field->blades, records);
    // One round: of the sizes of sown patches only the largest one is known.
    if (field->sowing && records.roundPatches == 0)
        own.roundPatches = field->blades.nonEmptyPatchCount();
    auto placed = std::make_unique<PlacedField>(context, *field, own);
    blades = placed.get();
    blades->expectViews(1);
    if (geometry == Geometry::raster && recorder.raster.drawsLargeByGroups())
        blades->expectHistory(0);
    recorder.placed.emplace(1, Recorder::Placed{.field = std::move(placed)});
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
    if (isStreamed() || isSown())
        parts_->source = field;
}

FieldRenderer::FieldRenderer(const gpu::DeviceContext& context, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(context, field, settings))
{
}

FieldRenderer::FieldRenderer(FieldRenderer&&) noexcept = default;
FieldRenderer::~FieldRenderer() = default;

bool FieldRenderer::Parts::sows(const field::FieldView& view) const
{
    return settings.sownBytes > 0 && render::isSown(view);
}

/// A field whose blades near the eye are sown.
std::unique_ptr<DeviceField> FieldRenderer::Parts::sownField(const field::FieldView& stored)
{
    const SownView whole(stored);
    const field::FieldView& view = whole.view();
    gpu::Uploader uploader(context);
    field::LeafAreaGrid grid = whole.leafArea();
    const float exposure = chosenExposure(view, grid);
    GrassCover cover(context, uploader, view, std::move(grid), settings.isEditable,
                     whole.bladesPerStored());
    // Pictures and ground need memory, too.
    const std::uint64_t most =
        (settings.deviceBytes > 0 ? settings.deviceBytes : context.deviceLocalBytes()) / 2;
    const std::uint64_t bytes = std::min(settings.sownBytes, most);
    const SownMemory memory =
        SownMemory::of(bytes, records.bytesPerBlade(false) + bytesOfSownList(records),
                       settings.framesInFlight, settings.sowsOnDevice, context.isCpu());
    requireMemory(context, view, records, {});
    const std::uint64_t places = view.blades.size() + memory.room.blades;
    if (geometry == Geometry::raster)
        expectNumbers(context, places, ground.triangleCount());
    const std::uint32_t walkStart = context.isCpu() ? shared::walkStart : shared::walkStartOfGpu;
    auto tables = settings.isEditable ? StoredCells::tablesFor(memory.room, view, walkStart)
                                      : std::make_unique<SownTables>(view, memory.room, walkStart);
    auto cells = settings.isEditable ? std::make_unique<StoredCells>(view, *tables) : nullptr;
    DeviceField::Settings own{.sown = std::move(tables),
                              .stored = std::move(cells),
                              .sowing = {.framesInFlight = settings.framesInFlight,
                                         .threads = settings.sowThreads,
                                         .waits = settings.waitsForDisk,
                                         .device = memory.device},
                              .framesInFlight = settings.framesInFlight,
                              .exposure = exposure};
    auto made = std::make_unique<DeviceField>(context, recorder.shaders, uploader, view,
                                              std::move(cover), std::move(own));
    uploader.finish();
    return made;
}

std::unique_ptr<DeviceField> FieldRenderer::Parts::uploadedField(const field::FieldView& view)
{
    if (sows(view))
        return sownField(view);
    gpu::Uploader uploader(context);
    field::LeafAreaGrid grid = field::leafAreaOf(view);
    const float exposure = chosenExposure(view, grid);
    GrassCover cover(context, uploader, view, std::move(grid), settings.isEditable);
    const MemoryPlan plan = planWithin(view, cover.bytes());
    requireMemory(context, view, records, plan);
    DeviceField::Settings own{.walkStart =
                                  context.isCpu() ? shared::walkStart : shared::walkStartOfGpu,
                              .pages = plan.pages,
                              .streaming = plan.streaming,
                              .framesInFlight = settings.framesInFlight,
                              .exposure = exposure,
                              .boundsRounds = true};
    if (settings.isEditable && plan.pages == 0)
        own.edited = editedOf(view);
    auto made = std::make_unique<DeviceField>(context, recorder.shaders, uploader, view,
                                              std::move(cover), std::move(own));
    uploader.finish();
    return made;
}

/// Pictures are allocated once to measure their memory.
MemoryPlan FieldRenderer::Parts::planWithin(const field::FieldView& view, VkDeviceSize coverBytes)
{
    if (settings.deviceBytes == 0)
        return {};
    measurePictures();
    std::uint64_t others = coverBytes + bytesBesideBlades() +
                           PlacedField::constantBytes(bladeSettings(settings)) +
                           (resolve ? resolve->bytesToCopy() : 0);
    if (geometry == Geometry::raster && recorder.raster.drawsLargeByGroups())
        others += VisibilityHistory::bytesOf(static_cast<std::uint32_t>(view.blades.size()));
    if (settings.castsShadows && recorder.bladeShadows.isPossible())
        others += BladeShadowPass::bytesFor(view.patches.size());
    return planFor(view, records,
                   {.bytes = settings.deviceBytes,
                    .others = others,
                    .framesInFlight = settings.framesInFlight,
                    .waitsForDisk = settings.waitsForDisk});
}

void FieldRenderer::Parts::measurePictures()
{
    fit(settings.largestTarget);
    const FrameSettings plain;
    const View view{.target = settings.largestTarget, .geometry = geometry};
    const HostView seen = hostView(view, plain);
    for (std::uint32_t slot = 0; slot < settings.framesInFlight; ++slot)
        recorder.begin(slot, {.views = {&seen, 1}, .settings = plain},
                       {.layer = geometry == Geometry::raster ? &layer : nullptr}, {});
}

std::unique_ptr<EditedField> FieldRenderer::Parts::editedOf(const field::FieldView& view) const
{
    const std::uint64_t triangles = geometry == Geometry::raster ? ground.triangleCount() : 0;
    return std::make_unique<EditedField>(
        view, context.isCpu() ? shared::walkStart : shared::walkStartOfGpu,
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
    frozen = {};
    if (geometry == Geometry::raster) {
        const VkExtent2D extent{size.x, size.y};
        opaqueRaster->resize(extent);
        resolve->resize(extent, opaqueRaster->lit());
        return;
    }
    attachments->resize(size);
    tessellated->resize(size);
}

/// What the recorder decides by. Its matrix only says that the rays are not parallel; the view's
/// own is in instanceOf().
HostView FieldRenderer::Parts::hostView(const View& view, const FrameSettings& wanted) const
{
    HostView result{.size = view.target, .samples = settings.samples, .geometry = view.geometry};
    result.worldToClip[2][3] = -1.0;
    if (wanted.cullingCamera)
        result.cullViewFrom = result.worldToClip;
    if (geometry == Geometry::tessellation && attachments->depth().view() != VK_NULL_HANDLE)
        result.depth = HostDepth{
            .view = attachments->depth().view(), .samples = settings.samples, .slack = 0.0f};
    return result;
}

InstanceFrame FieldRenderer::Parts::instanceOf(const View& view, const FrameSettings& wanted,
                                               double time)
{
    InstanceFrame result{.time = time, .number = frameNumber, .settings = wanted};
    result.colliders = collidersAt(wanted.colliders, field->shape.origin, time,
                                   blades->hasMoved() ? lastTime : time);
    InstanceView own{.seen = view.matrices,
                     .clipBefore = view.before.value_or(view.matrices.viewProjection),
                     .samples = settings.samples};
    const glm::mat4 rows = glm::transpose(view.matrices.viewProjection);
    own.shadowBox = shadowBoxOf(glm::dvec3(view.matrices.eye), glm::dvec3(rows[3]), wanted);
    if (wanted.cullingCamera)
        own.culled = viewMatrices(*wanted.cullingCamera, field->shape.origin, view.whole,
                                  field->shape.content);
    result.views.push_back(own);
    return result;
}

/// Writes a frame for the shaders.
void FieldRenderer::Parts::begin(const View& view, const FrameSettings& wanted, double time,
                                 std::uint32_t slot)
{
    requireUsage(wanted.debug != DebugMode::reason || settings.recordCullResults,
                 "DebugMode::reason needs FieldRendererSettings::recordCullResults");
    prepare(wanted);
    if (view.layers != 0)
        prepareLayers(wanted);
    elapsed = blades->hasMoved() ? static_cast<float>(std::max(time - lastTime, 0.0)) : 0.0f;
    const HostView seen = hostView(view, wanted);
    ViewExtras extras{.frozen = frozen,
                      .drawsAll = wanted.debug == DebugMode::reason,
                      .onlyMoves = view.onlyMoves};
    if (view.geometry == Geometry::raster) {
        layer.firstBlade = opaqueRaster->firstBlade();
        layer.clear = [this](const gpu::Recording& commands) {
            resolve->recordBegin(commands);
            opaqueRaster->recordBegin(commands);
        };
        layer.draw = [this](const gpu::Recording& commands, VkDeviceAddress visibility) {
            opaqueRaster->recordTriangles(commands, frame(), visibility);
        };
        extras.layer = &layer;
    }
    recorder.begin(slot, {.time = time, .views = {&seen, 1}, .settings = wanted}, extras,
                   [&](const Recorder::Placed&) {
                       InstanceFrame instance = instanceOf(view, wanted, time);
                       instance.complete = [this, colliders = instance.colliders](
                                               std::uint32_t, shared::Frame& written) {
                           sunShadow.describe(written, colliders);
                           // Under another sky the floor would be a slope.
                           if (glm::dot(written.skyUp, floorUp) > 0.9999f)
                               written.floorPlane = floorPlane;
                           return std::optional<shared::HostLight>();
                       };
                       return instance;
                   });
    sunShadow.prepare(recorder.shaders);
    if (extras.layer != nullptr)
        resolve->prepare(recorder.shaders,
                         {.debugMode = knownDebugMode(wanted.debug),
                          .limitsLeafArea = testsOf(wanted).maxLeafArea > 0.0f,
                          .hasShadingCache = recorder.drawings.front().hasTwoPasses});
}

/// Creates pipelines of the ground, and of the tessellator, that a frame needs for the first time.
void FieldRenderer::Parts::prepare(const FrameSettings& wanted)
{
    const gpu::ShaderLibrary& shaders = recorder.shaders;
    const auto colliders = static_cast<std::uint32_t>(wanted.colliders.size());
    const std::uint32_t debugMode = knownDebugMode(wanted.debug);
    const bool paintsWind = wanted.debug == DebugMode::wind;
    if (geometry == Geometry::raster) {
        opaqueRaster->prepare(shaders, colliders, debugMode);
    } else {
        opaque->prepare(shaders, colliders, paintsWind);
        tessellated->prepare(shaders, paintsWind);
    }
}

void FieldRenderer::record(VkCommandBuffer buffer, const Target& target, const Camera& camera,
                           const FrameSettings& settings, double time, std::uint32_t slot,
                           gpu::Timestamps* timestamps, glm::vec2 jitter)
{
    Parts& parts = *parts_;
    const gpu::Recording commands = parts.recording(buffer, settings, time, slot);
    requireUsage(target.image != VK_NULL_HANDLE && target.view != VK_NULL_HANDLE,
                 "FieldRenderer::Target: its image or its view is null");
    const gpu::LabelScope label(parts.context, commands, "field");

    const bool isPart = target.whole != glm::uvec2(0);
    requireUsage(!isPart || !isStreamed(), "a streamed field's picture is drawn as a whole");
    const glm::uvec2 whole = isPart ? target.whole : target.size;
    const DeviceField& field = *parts.field;
    ViewMatrices matrices =
        viewMatrices(camera, field.shape.origin, whole, field.shape.content, jitter);
    if (isPart)
        matrices = partOf(matrices, whole, target.first, target.size);
    parts.fit(target.size);
    parts.checkLayers(target);
    const std::optional<glm::mat4> before = parts.projectionBefore(target, whole);
    parts.begin({target.size, whole, matrices, parts.geometry, before, target.layers}, settings,
                time, slot);
    parts.seenBefore = matrices.viewProjection;
    parts.lastTime = time;
    ++parts.frameNumber;
    {
        const DispatchScope scope(parts.context, commands, timestamps, "sun shadow");
        parts.sunShadow.record(commands, parts.ground, parts.frame().address);
    }

    Recorder& recorder = parts.recorder;
    recorder.recordUpdate(commands);
    const bool looksForHidden = (settings.cullMask & shared::cullOcclusion) != 0;
    if (parts.geometry == Geometry::tessellation)
        parts.drawOpaque(commands, target, timestamps);
    // Blades hidden by the ground are neither moved nor drawn.
    recorder.recordCull(commands, 0, timestamps);
    if (parts.geometry == Geometry::raster) {
        recorder.recordRaster(commands, 0, timestamps);
        parts.makePicture(commands, target, timestamps);
    } else {
        parts.drawBlades(commands, target, timestamps);
        parts.tessellated->finish(commands, target.view);
    }
    if (!settings.cullingCamera)
        parts.frozen = looksForHidden ? recorder.depthOf(0).cells.layout : shared::DepthPyramid{};
}

void FieldRenderer::recordUpdateOnly(VkCommandBuffer buffer, const FrameSettings& settings,
                                     double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    const gpu::Recording commands = parts.recording(buffer, settings, time, slot);
    const gpu::LabelScope label(parts.context, commands, "field/update only");
    FrameSettings unseen = settings;
    unseen.cullMask &= ~std::uint32_t(cullOcclusion);
    parts.begin({.target = glm::uvec2(1), .geometry = Geometry::tessellation, .onlyMoves = true},
                unseen, time, slot);
    parts.lastTime = time;
    ++parts.frameNumber;
    parts.recorder.recordMoveAll(commands);
}

bool FieldRenderer::recordStreaming(VkCommandBuffer buffer, glm::uvec2 size, const Camera& camera,
                                    const FrameSettings& settings, double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    const gpu::Recording commands = parts.recording(buffer, settings, time, slot);
    if (!isStreamed() && !isSown())
        return true;
    const gpu::LabelScope label(parts.context, commands, "field/streaming");
    const DeviceField& field = *parts.field;
    const bool hadMoved = parts.blades->hasMoved();
    parts.begin({.target = size,
                 .whole = size,
                 .matrices = viewMatrices(camera, field.shape.origin, size, field.shape.content),
                 .geometry = parts.geometry},
                settings, time, slot);
    if (!hadMoved)
        parts.lastTime = time;
    parts.recorder.recordUpdate(commands);
    return isSettled();
}

std::optional<VkSemaphoreSubmitInfo> FieldRenderer::copied() const
{
    return isStreamed() ? parts_->field->streaming->copied() : std::nullopt;
}

FrameStats FieldRenderer::stats(std::uint32_t slot) const
{
    requireUsage(slot < parts_->settings.framesInFlight, "slot {} of {}", slot,
                 parts_->settings.framesInFlight);
    FrameStats stats;
    parts_->blades->addCounts(slot, 0, stats);
    return stats;
}

std::vector<FieldRenderer::BladeRecord>
FieldRenderer::dumpBlades(const field::FieldView& field) const
{
    const DeviceField& own = *parts_->field;
    requireUsage(field.blades.size() == own.blades.bladeCount(),
                 "a field of {} blades; that of the renderer has {}", field.blades.size(),
                 own.blades.bladeCount());
    if (isStreamed())
        fail(ErrorKind::unsupported,
             "not all of the field's {} blades are in device memory; "
             "only those in memory have a state",
             field.blades.size());
    std::vector<std::uint32_t> places;
    if (own.edits)
        places = own.edits->field().placesOf(field);
    else if (own.sowing)
        places = own.sowing->placesOf(field);
    return readBlades(parts_->context, *parts_->blades, field, places);
}

std::vector<SownPatch> FieldRenderer::sownPatches() const
{
    std::vector<SownPatch> found;
    if (!isSown())
        return found;
    for (const SownTables::Resident& resident : parts_->field->sowing->residents())
        for (std::uint32_t i = 0; i < resident.patches.size(); ++i) {
            SownPatch& patch = found.emplace_back(resident.unit, i);
            patch.bounds.add(resident.patches[i].boundsLow);
            patch.bounds.add(resident.patches[i].boundsHigh);
        }
    return found;
}

SownDump FieldRenderer::dumpSown(const field::FieldView& field, const SownPatch& patch) const
{
    const std::optional<SownTables::Resident> resident =
        isSown() ? parts_->field->sowing->residentOf(patch.unit) : std::nullopt;
    if (!resident || patch.patch >= resident->patches.size())
        return {};
    return readSown(parts_->context, *parts_->blades, field, resident->patches[patch.patch]);
}

field::BladeKey FieldRenderer::keyOf(const SownPatch& patch, std::uint32_t index) const
{
    requireUsage(isSown(), "a field of which nothing is sown");
    const field::GrownUnit grown = parts_->field->sowing->grownAgain(patch.unit);
    requireUsage(patch.patch < grown.patches.size() &&
                     index < grown.patches[patch.patch].bladeCount,
                 "blade {} of patch {} of a sown unit", index, patch.patch);
    return grown.keys[grown.patches[patch.patch].firstBlade + index];
}

std::vector<FieldRenderer::BladeRecord> FieldRenderer::dumpPatch(const field::FieldView& field,
                                                                 std::uint32_t patch) const
{
    requireUsage(patch < field.patches.size(), "patch {} of {}", patch, field.patches.size());
    const DeviceField& own = *parts_->field;
    const shared::Patch& cell = field.patches[patch];
    std::vector<BladePart> parts{{cell.firstBlade, cell.bladeCount}};
    if (own.streaming)
        parts = own.streaming->partsOf(cell);
    if (own.edits && cell.bladeCount > 0)
        parts = {{own.edits->field().placesOf(field)[cell.firstBlade], cell.bladeCount}};
    if (own.sowing && own.sowing->isEditable() && cell.bladeCount > 0)
        parts = {{own.sowing->placesOf(field)[cell.firstBlade], cell.bladeCount}};
    return readPatch(parts_->context, *parts_->blades, field, patch, parts);
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
    const std::size_t pictures = geometry == Geometry::raster
                                     ? opaqueRaster->bytes() + resolve->bytes()
                                     : attachments->bytes() + opaque->bytes();
    return ground.bytes() + sunShadow.bytes() + pictures + recorder.deviceBytes();
}

std::size_t FieldRenderer::deviceBytes() const
{
    return parts_->field->bytes() + parts_->bytesBesideBlades();
}

bool FieldRenderer::isStreamed() const
{
    return parts_->field->streaming != nullptr;
}

bool FieldRenderer::isSown() const
{
    return parts_->field->sowing != nullptr;
}

bool FieldRenderer::isSettled() const
{
    const DeviceField& field = *parts_->field;
    if (field.sowing)
        return field.sowing->isSettled();
    return field.streaming == nullptr || field.streaming->isSettled();
}

Aabb FieldRenderer::content() const
{
    return parts_->field->shape.content;
}

} // namespace sward::render
