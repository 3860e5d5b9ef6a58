#include "render/field_renderer.h"

#include "core/embedded.h"
#include "core/error.h"
#include "core/expect.h"
#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/image_use.h"
#include "gpu/rendering.h"
#include "render/attachments.h"
#include "render/blade_dump.h"
#include "render/depth_pyramid.h"
#include "render/frame.h"
#include "render/frame_slot.h"
#include "render/grass_cover.h"
#include "render/judged_frame.h"
#include "render/moving_blades.h"
#include "render/pass_scope.h"
#include "render/raster_pass.h"
#include "render/solid_pass.h"
#include "render/sun_shadow.h"
#include "render/tessellated_pass.h"

#include <optional>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted)
{
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
    if (wanted.geometry == Geometry::raster && obstacle != nullptr)
        fail(ErrorKind::unsupported, "{} cannot rasterise blades: {}", context.name, obstacle);
    if (wanted.geometry == Geometry::automatic)
        return obstacle == nullptr && !context.isCpu() ? Geometry::raster : Geometry::tessellation;
    return wanted.geometry;
}

FieldBuffers::Records recordsFor(Geometry geometry, const FieldRenderer::Settings& wanted)
{
    return {.list = geometry == Geometry::tessellation || wanted.recordFates,
            .fates = wanted.recordFates,
            .roundPatches = wanted.roundPatches};
}

/// The rasteriser reads what the graphics pipeline has drawn. What solid things look like is asked
/// only where no blade hides them.
TargetSettings targetFor(Geometry geometry, const FieldRenderer::Settings& wanted)
{
    return {.colorFormat = wanted.colorFormat,
            .samples = wanted.samples,
            .isSampled = geometry == Geometry::raster,
            .lightsLater = geometry == Geometry::raster};
}

/// Uploads all that a field brings, and waits for it.
template <typename T, typename... Arguments>
T uploaded(const gpu::DeviceContext& context, const Arguments&... arguments)
{
    gpu::Uploader uploader(context);
    T result(context, uploader, arguments...);
    uploader.finish();
    return result;
}

} // namespace

struct FieldRenderer::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field,
          const Settings& wanted)
        : context(deviceContext)
        , settings(wanted)
        , geometry(chooseGeometry(context, wanted))
        , attachments(context, targetFor(geometry, wanted))
        , blades(context, shaders,
                 uploaded<FieldBuffers>(context, field, recordsFor(geometry, wanted)))
        , ground(uploaded<GroundBuffers>(context, *field.ground))
        , cover(uploaded<GrassCover>(context, field))
        , sunShadow(context, shaders, ground.box())
        , pyramid(context, shaders, wanted.samples)
        , solid(context, shaders, targetFor(geometry, wanted), ground)
        , shape{field.origin, field.bounds(), blades.buffers().bladeSize()}
    {
        expect(wanted.framesInFlight >= 1, "at least one frame is in flight");
        if (geometry == Geometry::raster)
            raster.emplace(context, shaders, targetFor(geometry, wanted));
        else
            tessellated.emplace(context, shaders, targetFor(geometry, wanted));
        for (std::uint32_t i = 0; i < wanted.framesInFlight; ++i)
            slots.emplace_back(context);
    }

    const gpu::DeviceContext& context;
    Settings settings;
    Geometry geometry;
    gpu::ShaderLibrary shaders{settings.shaders.empty() ? embedded::shaders() : settings.shaders};
    Attachments attachments;
    MovingBlades blades;
    GroundBuffers ground;
    GrassCover cover;
    SunShadowPass sunShadow;
    DepthPyramid pyramid;
    SolidPass solid;

    std::optional<TessellatedPass> tessellated; ///< the one or …
    std::optional<RasterPass> raster;           ///< … the other, by the geometry
    FieldShape shape;
    std::vector<FrameSlot> slots;
    double lastTime = 0.0; ///< [s] of the frame before
    std::uint32_t frameNumber = 0;
    bool paintsWind = false;
    bool hasPyramid = false; ///< of the picture's size, and of the culling camera

    shared::Frame writeFrame(shared::Frame frame, const FrameSettings& wishes, double time,
                             std::uint32_t slot);
    VkDeviceAddress judge(const shared::Frame& frame, const FrameSettings& wishes, glm::uvec2 size,
                          std::uint32_t slot);
    void drawSolid(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                   gpu::Timestamps* timestamps);
    void lightSolid(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void seeWhatIsHidden(VkCommandBuffer commands, std::uint32_t slot, gpu::Timestamps* timestamps);
    void drawBlades(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                    gpu::Timestamps* timestamps);
    void rasterBlades(VkCommandBuffer commands, std::uint32_t slot, VkDeviceAddress judged,
                      gpu::Timestamps* timestamps);
    void resolve(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                 VkDeviceAddress judged, gpu::Timestamps* timestamps);
    gpu::ColorAttachment colorAttachment(const Target& target) const;
};

FieldRenderer::FieldRenderer(const gpu::Device& device, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(device.context(), field, settings))
{
}

FieldRenderer::FieldRenderer(const gpu::DeviceContext& context, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(context, field, settings))
{
}

FieldRenderer::FieldRenderer(FieldRenderer&&) noexcept = default;
FieldRenderer::~FieldRenderer() = default;

shared::Frame FieldRenderer::Parts::writeFrame(shared::Frame frame, const FrameSettings& wishes,
                                               double time, std::uint32_t slot)
{
    blades.buffers().describe(frame);
    cover.describe(frame);
    if ((frame.view.cullMask & shared::cullOcclusion) != 0)
        pyramid.describe(frame);
    slots[slot].tables.write(shape, wishes, time, blades.hasMoved() ? lastTime : time, frame);
    lastTime = time;
    frame.pace.frame = frameNumber++;
    sunShadow.describe(frame);
    fill(slots[slot].frame, frame);

    // What is asked for the first time is made now.
    blades.prepare(shaders, frame);
    paintsWind = wishes.debug == DebugMode::wind;
    solid.prepare(shaders, frame.nature.colliderCount, paintsWind);
    if (raster)
        raster->prepare(shaders, paintsWind);
    else
        tessellated->prepare(shaders, paintsWind);
    return frame;
}

VkDeviceAddress FieldRenderer::Parts::judge(const shared::Frame& frame, const FrameSettings& wishes,
                                            glm::uvec2 size, std::uint32_t slot)
{
    expect(wishes.debug != DebugMode::reason || settings.recordFates,
           "who asks for reasons has them recorded");
    if (wishes.debug == DebugMode::reason)
        fill(slots[slot].listing, listingAll(frame));
    if (!wishes.cullingCamera)
        return slots[slot].frame.address();
    shared::Frame judged =
        judgedFrom(frame, viewMatrices(*wishes.cullingCamera, shape.origin, size, shape.content));
    if (!hasPyramid)
        judged.pyramid = {};
    fill(slots[slot].judged, judged);
    return slots[slot].judged.address();
}

void FieldRenderer::record(VkCommandBuffer commands, const Target& target, const Camera& camera,
                           const FrameSettings& settings, double time, std::uint32_t slot,
                           gpu::Timestamps* timestamps, glm::vec2 jitter)
{
    Parts& parts = *parts_;
    expect(slot < parts.slots.size(), "the slot is one of the frames in flight");
    const gpu::LabelScope label(parts.context, commands, "field");

    const ViewMatrices view =
        viewMatrices(camera, parts.shape.origin, target.size, parts.shape.content, jitter);
    if (parts.attachments.resize(target.size)) {
        parts.pyramid.resize(parts.attachments.depth());
        parts.hasPyramid = false;
        if (parts.raster)
            parts.raster->resize(parts.attachments);
        else
            parts.tessellated->resize(target.size);
    }
    const shared::Frame frame = parts.writeFrame(
        frameOf(parts.shape, view, settings, time, parts.settings.samples), settings, time, slot);
    const VkDeviceAddress judged = parts.judge(frame, settings, target.size, slot);
    parts.sunShadow.record(commands, parts.ground, parts.slots[slot].frame.address(),
                           parts.solid.colliders());

    // What the ground hides needs neither be moved nor drawn.
    parts.drawSolid(commands, target, slot, timestamps);
    const bool looksForHidden = (settings.cullMask & shared::cullOcclusion) != 0;
    if (!settings.cullingCamera) {
        if (looksForHidden)
            parts.seeWhatIsHidden(commands, slot, timestamps);
        parts.hasPyramid = looksForHidden;
    }
    parts.blades.begin(commands, time);
    parts.blades.findLive(commands, judged, timestamps);
    VkDeviceAddress listedBy = judged;
    const bool findsReasons = settings.debug == DebugMode::reason;
    if (findsReasons) {
        // All blades are drawn, in the colours of what becomes of them.
        parts.blades.moveAndList(commands, judged, 0, timestamps);
        parts.slots[slot].recordCounts(commands, parts.blades.buffers().draw());
        listedBy = parts.slots[slot].listing.address();
        parts.blades.beginAgain(commands);
        parts.blades.findLive(commands, listedBy, nullptr);
    }
    if (parts.raster)
        parts.rasterBlades(commands, slot, listedBy, timestamps);
    else
        parts.blades.moveAndList(commands, listedBy, 0, timestamps);

    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    if (!findsReasons)
        parts.slots[slot].recordCounts(commands, parts.blades.buffers().draw());
    if (parts.raster) {
        parts.lightSolid(commands, target, slot, timestamps);
        parts.resolve(commands, target, slot, listedBy, timestamps);
    } else {
        parts.drawBlades(commands, target, slot, timestamps);
        parts.tessellated->finish(commands, target.view);
    }
}

gpu::ColorAttachment FieldRenderer::Parts::colorAttachment(const Target& target) const
{
    gpu::ColorAttachment color{
        .view = target.view, .resolve = VK_NULL_HANDLE, .clear = std::nullopt};
    if (attachments.hasColor())
        color.view = attachments.color().view();
    return color;
}

void FieldRenderer::Parts::drawSolid(VkCommandBuffer commands, const Target& target,
                                     std::uint32_t slot, gpu::Timestamps* timestamps)
{
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::undefined,
                    gpu::ImageUse::depthTarget);
    const VkDeviceAddress frame = slots[slot].frame.address();
    const gpu::DepthAttachment depth{.view = attachments.depth().view(), .clear = 0.0f};
    const VkExtent2D extent{target.size.x, target.size.y};
    const PassScope scope(context, commands, timestamps, "ground");
    if (raster) {
        const gpu::RenderingScope rendering(commands, extent, {}, depth);
        solid.recordDepth(commands, frame);
        return;
    }
    if (attachments.hasColor())
        gpu::transition(commands, attachments.color(), gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
    gpu::ColorAttachment color = colorAttachment(target);
    color.clear = std::array{0.0f, 0.0f, 0.0f, 1.0f};
    const gpu::RenderingScope rendering(commands, extent, std::span(&color, 1), depth);
    solid.record(commands, frame, {});
}

void FieldRenderer::Parts::lightSolid(VkCommandBuffer commands, const Target& target,
                                      std::uint32_t slot, gpu::Timestamps* timestamps)
{
    const PassScope scope(context, commands, timestamps, "ground");
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::sampled,
                    gpu::ImageUse::depthTarget);
    gpu::transition(commands, attachments.color(), gpu::ImageUse::sampled,
                    gpu::ImageUse::colorTarget);
    {
        gpu::ColorAttachment color = colorAttachment(target);
        color.clear = std::array{0.0f, 0.0f, 0.0f, 1.0f};
        const gpu::DepthAttachment depth{.view = attachments.depth().view(), .clear = std::nullopt};
        const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                            std::span(&color, 1), depth);
        solid.record(commands, slots[slot].frame.address(), {raster->visibility(), target.size.x});
    }
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
    gpu::transition(commands, attachments.color(), gpu::ImageUse::colorTarget,
                    gpu::ImageUse::sampled);
}

void FieldRenderer::Parts::seeWhatIsHidden(VkCommandBuffer commands, std::uint32_t slot,
                                           gpu::Timestamps* timestamps)
{
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
    {
        const PassScope scope(context, commands, timestamps, "pyramid");
        // The frame before may still be looking at what is filled anew.
        gpu::memoryBarrier(commands, gpu::computeAccess, gpu::computeAccess);
        pyramid.record(commands, slots[slot].frame.address());
    }
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::sampled,
                    gpu::ImageUse::depthTarget);
}

void FieldRenderer::Parts::drawBlades(VkCommandBuffer commands, const Target& target,
                                      std::uint32_t slot, gpu::Timestamps* timestamps)
{
    gpu::ColorAttachment color = colorAttachment(target);
    color.resolve = tessellated->begin(commands);
    color.isKept = color.resolve == VK_NULL_HANDLE;
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::depthTarget);
    gpu::transition(commands, attachments.hasColor() ? attachments.color().get() : target.image,
                    VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::colorTarget);
    const gpu::DepthAttachment depth{
        .view = attachments.depth().view(), .clear = std::nullopt, .isKept = false};

    const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                        std::span(&color, 1), depth);
    tessellated->record(commands, blades.buffers(), slots[slot].frame.address(), timestamps);
}

void FieldRenderer::Parts::rasterBlades(VkCommandBuffer commands, std::uint32_t slot,
                                        VkDeviceAddress judged, gpu::Timestamps* timestamps)
{
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
    // Bound with the depth, and not read yet.
    gpu::transition(commands, attachments.color(), gpu::ImageUse::undefined,
                    gpu::ImageUse::sampled);
    const RasterPass::Input input{&blades.buffers(), slots[slot].frame.address(), judged};
    {
        const PassScope scope(context, commands, timestamps, "blades");
        raster->recordBegin(commands, input);
    }
    for (std::uint32_t round = 0; round < blades.buffers().roundCount(); ++round) {
        // The round before draws from the list that is filled anew.
        if (round > 0)
            gpu::computeToCompute(commands);
        blades.moveAndList(commands, judged, round, timestamps);
        gpu::computeToCompute(commands);
        const PassScope scope(context, commands, timestamps, "blades");
        raster->recordBlades(commands, input, round);
    }
    gpu::computeToCompute(commands);
    const PassScope scope(context, commands, timestamps, "blades");
    raster->recordLarge(commands, input);
}

void FieldRenderer::Parts::resolve(VkCommandBuffer commands, const Target& target,
                                   std::uint32_t slot, VkDeviceAddress judged,
                                   gpu::Timestamps* timestamps)
{
    const PassScope scope(context, commands, timestamps, "resolve");
    raster->recordResolve(commands, {&blades.buffers(), slots[slot].frame.address(), judged},
                          paintsWind);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::transferTarget);
    raster->copyTo(commands, target.image);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::transferTarget, gpu::ImageUse::colorTarget);
}

void FieldRenderer::recordUpdateOnly(VkCommandBuffer commands, const FrameSettings& settings,
                                     double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    expect(slot < parts.slots.size(), "the slot is one of the frames in flight");
    const gpu::LabelScope label(parts.context, commands, "field/update only");
    parts.writeFrame(frameOf(parts.shape, ViewMatrices{}, settings, time, parts.settings.samples),
                     settings, time, slot);
    parts.blades.begin(commands, time);
    parts.blades.moveAll(commands, parts.slots[slot].frame.address());
}

FrameStats FieldRenderer::stats(std::uint32_t slot) const
{
    expect(slot < parts_->slots.size(), "the slot is one of the frames in flight");
    return parts_->slots[slot].counts(parts_->blades.buffers().bladeCount());
}

std::vector<FieldRenderer::BladeRecord>
FieldRenderer::dumpBlades(const field::FieldView& field) const
{
    expect(field.blades.size() == parts_->blades.buffers().bladeCount(),
           "the field is the one uploaded");
    return readBlades(parts_->context, parts_->blades.buffers(), field);
}

std::vector<FieldRenderer::BladeRecord> FieldRenderer::dumpPatch(const field::FieldView& field,
                                                                 std::uint32_t patch) const
{
    expect(patch < field.patches.size(), "the patch is one of the field's");
    return readPatch(parts_->context, parts_->blades.buffers(), field, patch);
}

Geometry FieldRenderer::geometry() const
{
    return parts_->geometry;
}

const char* FieldRenderer::geometryReason() const
{
    const Parts& parts = *parts_;
    if (parts.settings.geometry != Geometry::automatic)
        return "asked for";
    const char* obstacle = obstacleToRaster(parts.context, parts.settings.colorFormat);
    if (obstacle != nullptr)
        return obstacle;
    return parts.context.isCpu()
               ? "a CPU's compute shaders leave lanes idle: its tessellator is faster"
               : "compute shaders draw blades faster than the tessellator";
}

std::size_t FieldRenderer::deviceBytes() const
{
    return parts_->blades.buffers().bytes() + parts_->ground.bytes() + parts_->cover.bytes() +
           parts_->sunShadow.bytes() + parts_->pyramid.bytes() +
           (parts_->raster ? parts_->raster->bytes() : 0) + parts_->attachments.bytes() +
           parts_->slots.size() * FrameSlot::bytes();
}

Aabb FieldRenderer::content() const
{
    return parts_->shape.content;
}

} // namespace sward::render
