#include "render/field_renderer.h"

#include "core/embedded.h"
#include "core/expect.h"
#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/image_use.h"
#include "gpu/rendering.h"
#include "render/attachments.h"
#include "render/blade_dump.h"
#include "render/blade_pass.h"
#include "render/field_buffers.h"
#include "render/frame.h"
#include "render/frame_tables.h"
#include "render/grass_cover.h"
#include "render/ground_pass.h"
#include "render/pass_scope.h"
#include "render/sky_pass.h"
#include "render/sun_shadow.h"
#include "render/update_cull_pass.h"

#include <cstring>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

/// Before its first frame a field has stood in its wind for so long [s] that no blade is still on
/// its way from the straight pose it was baked in.
constexpr double settlingTime = 12.0;

/// What each frame in flight has of its own.
struct Slot {
    gpu::Buffer frame; ///< shared::Frame, written by the CPU
    gpu::Buffer draw;  ///< shared::DrawArguments, read by the CPU
    FrameTables tables;
};

Slot createSlot(const gpu::DeviceContext& context)
{
    return {gpu::Buffer(context, {.name = "frame/constants",
                                  .bytes = sizeof(shared::Frame),
                                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                  .memory = gpu::MemoryUse::upload}),
            gpu::Buffer(context, {.name = "frame/counts",
                                  .bytes = sizeof(shared::DrawArguments),
                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  .memory = gpu::MemoryUse::readback}),
            FrameTables(context)};
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
        , attachments(context, {wanted.colorFormat, wanted.samples})
        , blades(uploaded<FieldBuffers>(context, field, wanted.recordFates))
        , ground(uploaded<GroundBuffers>(context, *field.ground))
        , cover(uploaded<GrassCover>(context, field))
        , sunShadow(context, shaders, ground.box())
        , updateCull(context)
        , groundPass(context, shaders, {wanted.colorFormat, wanted.samples}, ground.imageLayout())
        , bladePass(context, shaders, {wanted.colorFormat, wanted.samples})
        , skyPass(context, shaders, {wanted.colorFormat, wanted.samples})
        , shape{field.origin, field.bounds(), blades.bladeWidth()}
    {
        expect(wanted.framesInFlight >= 1, "at least one frame is in flight");
        for (std::uint32_t i = 0; i < wanted.framesInFlight; ++i)
            slots.push_back(createSlot(context));
    }

    const gpu::DeviceContext& context;
    Settings settings;
    gpu::ShaderLibrary shaders{embedded::shaders()};
    Attachments attachments;
    FieldBuffers blades;
    GroundBuffers ground;
    GrassCover cover;
    SunShadowPass sunShadow;
    UpdateCullPass updateCull;
    GroundPass groundPass;
    BladePass bladePass;
    SkyPass skyPass;

    /// Ground and blades that show the wind, for those who ask.
    struct WindPaint {
        GroundPass ground;
        BladePass blades;
    };
    std::unique_ptr<WindPaint> windPaint;
    FieldShape shape;
    std::vector<Slot> slots;
    UpdateCullPass::Variant variant; ///< for the frame that is being recorded
    bool hasSettled = false;
    double lastTime = 0.0; ///< [s] of the frame before
    bool paintsWind = false;

    void writeFrame(shared::Frame frame, const FrameSettings& wishes, double time,
                    std::uint32_t slot);
    void moveAndCull(VkCommandBuffer commands, double time, std::uint32_t slot,
                     UpdateCullPass::Scope scope);
    void draw(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
              gpu::Timestamps* timestamps);
};

FieldRenderer::FieldRenderer(const gpu::Device& device, const field::FieldView& field,
                             const Settings& settings)
    : parts_(std::make_unique<Parts>(device.context(), field, settings))
{
}

FieldRenderer::FieldRenderer(FieldRenderer&&) noexcept = default;
FieldRenderer::~FieldRenderer() = default;

void FieldRenderer::Parts::writeFrame(shared::Frame frame, const FrameSettings& wishes, double time,
                                      std::uint32_t slot)
{
    blades.describe(frame);
    cover.describe(frame);
    sunShadow.describe(frame);
    // Before the first frame nothing has moved.
    slots[slot].tables.write(shape, wishes, time, hasSettled ? lastTime : time, frame);
    lastTime = time;
    std::memcpy(slots[slot].frame.mapped().data(), &frame, sizeof frame);

    // What is asked for the first time is made now.
    variant = {frame.nature.wind.counts, frame.nature.colliderCount > 0};
    updateCull.prepare(shaders, variant);
    if (wishes.debug == DebugMode::wind && windPaint == nullptr) {
        const TargetSettings target{settings.colorFormat, settings.samples, true};
        windPaint = std::make_unique<WindPaint>(
            WindPaint{GroundPass(context, shaders, target, ground.imageLayout()),
                      BladePass(context, shaders, target)});
    }
    paintsWind = wishes.debug == DebugMode::wind;
}

void FieldRenderer::Parts::moveAndCull(VkCommandBuffer commands, double time, std::uint32_t slot,
                                       UpdateCullPass::Scope scope)
{
    // Wait for the frame before, which draws from the same lists, and clear them.
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    blades.clearCounts(commands);
    if (!hasSettled)
        blades.rest(commands, static_cast<float>(time - settlingTime));
    hasSettled = true;
    gpu::transferToCompute(commands);

    updateCull.record(commands, blades, slots[slot].frame.address(), variant, scope);
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
    parts.writeFrame(frameOf(parts.shape, view, settings, time, parts.settings.samples), settings,
                     time, slot);
    parts.sunShadow.record(commands, parts.ground, parts.slots[slot].frame.address());
    {
        const PassScope scope(parts.context, commands, timestamps, "update");
        parts.moveAndCull(commands, time, slot, UpdateCullPass::Scope::visible);
    }

    // Hand the list to the draw, and the counts to whoever asks for them.
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    const VkBufferCopy counts{0, 0, sizeof(shared::DrawArguments)};
    vkCmdCopyBuffer(commands, parts.blades.draw().get(), parts.slots[slot].draw.get(), 1, &counts);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);

    parts.attachments.resize(target.size);
    parts.draw(commands, target, slot, timestamps);
}

void FieldRenderer::Parts::draw(VkCommandBuffer commands, const Target& target, std::uint32_t slot,
                                gpu::Timestamps* timestamps)
{
    // Last frame's depth and samples are given up.
    gpu::transition(commands, attachments.depth(), gpu::ImageUse::undefined,
                    gpu::ImageUse::depthTarget);
    gpu::ColorAttachment color{.view = target.view,
                               .resolve = VK_NULL_HANDLE,
                               .clear = std::array{0.0f, 0.0f, 0.0f, 1.0f}};
    if (attachments.isResolved()) {
        gpu::transition(commands, attachments.color(), gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
        color.view = attachments.color().view();
        color.resolve = target.view;
        color.isKept = false;
    }
    const gpu::DepthAttachment depth{
        .view = attachments.depth().view(), .clear = 0.0f, .isKept = false};

    const VkDeviceAddress frame = slots[slot].frame.address();
    const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                        std::span(&color, 1), depth);
    {
        const PassScope scope(context, commands, timestamps, "ground");
        (paintsWind ? windPaint->ground : groundPass).record(commands, ground, frame);
    }
    {
        const PassScope scope(context, commands, timestamps, "blades");
        (paintsWind ? windPaint->blades : bladePass).record(commands, blades, frame);
    }
    {
        const PassScope scope(context, commands, timestamps, "sky");
        skyPass.record(commands, frame);
    }
}

void FieldRenderer::recordUpdateOnly(VkCommandBuffer commands, const FrameSettings& settings,
                                     double time, std::uint32_t slot)
{
    Parts& parts = *parts_;
    expect(slot < parts.slots.size(), "the slot is one of the frames in flight");
    const gpu::LabelScope label(parts.context, commands, "field/update only");
    parts.writeFrame(frameOf(parts.shape, ViewMatrices{}, settings, time, parts.settings.samples),
                     settings, time, slot);
    parts.moveAndCull(commands, time, slot, UpdateCullPass::Scope::all);
}

FrameStats FieldRenderer::stats(std::uint32_t slot) const
{
    expect(slot < parts_->slots.size(), "the slot is one of the frames in flight");
    const shared::DrawArguments counts =
        parts_->slots[slot].draw.mappedAs<shared::DrawArguments>()[0];
    FrameStats stats;
    stats.total = parts_->blades.bladeCount();
    stats.resident = stats.total;
    stats.simulated = counts.simulated;
    stats.drawn = counts.fates[shared::fateDrawn];
    stats.lod = counts.fates[shared::fateLod];
    stats.culledPatch = counts.fates[shared::fatePatch];
    stats.culledOrientation = counts.fates[shared::fateOrientation];
    stats.culledFrustum = counts.fates[shared::fateFrustum];
    stats.culledDistance = counts.fates[shared::fateDistance];
    stats.culledOcclusion = counts.fates[shared::fateOcclusion];
    return stats;
}

std::vector<FieldRenderer::BladeRecord>
FieldRenderer::dumpBlades(const field::FieldView& field) const
{
    expect(field.blades.size() == parts_->blades.bladeCount(), "the field is the one uploaded");
    return readBlades(parts_->context, parts_->blades, field);
}

std::size_t FieldRenderer::deviceBytes() const
{
    return parts_->blades.bytes() + parts_->ground.bytes() + parts_->cover.bytes() +
           parts_->sunShadow.bytes() + parts_->attachments.bytes() +
           parts_->slots.size() *
               (sizeof(shared::Frame) + sizeof(shared::DrawArguments) + FrameTables::bytes());
}

Aabb FieldRenderer::content() const
{
    return parts_->shape.content;
}

} // namespace sward::render
