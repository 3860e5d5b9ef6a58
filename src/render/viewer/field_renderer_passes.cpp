#include "core/error.h"
#include "field/measure/distributions.h"
#include "gpu/memory/format_kind.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "render/cull/pass_scope.h"
#include "render/frame/frame_time.h"
#include "render/host/host_checks.h"
#include "render/viewer/field_renderer_parts.h"

namespace sward::render {

void FieldRenderer::apply(const field::Delta& delta)
{
    Parts& parts = *parts_;
    if (parts.streaming)
        fail(ErrorKind::unsupported, "a field that is larger than its budget of device memory "
                                     "cannot be edited while it is shown");
    requireUsage(parts.blades.edited() != nullptr, "FieldRendererSettings::isEditable is not set");
    parts.blades.apply(delta);
    if (parts.raster)
        parts.raster->expectBlades(parts.blades.buffers().baked().placeCount(),
                                   parts.blades.replaced());
    followEdit(parts.shape, *parts.blades.edited());
}

const gpu::DeviceContext& FieldRenderer::Parts::checked(const gpu::DeviceContext& given,
                                                        const field::FieldView& field,
                                                        const Settings& wanted)
{
    gpu::requireDevice(given);
    requireUsage(field.ground != nullptr && field.defaults != nullptr,
                 "the field view has no ground or no defaults");
    requireUsage(wanted.framesInFlight >= 1, "FieldRendererSettings::framesInFlight is 0");
    requireUsage(wanted.samples == 1 || wanted.samples == 4,
                 "FieldRendererSettings::samples is {}, not 1 or 4", wanted.samples);
    const gpu::FormatKind kind = gpu::formatKind(wanted.colorFormat);
    requireUsage(kind == gpu::FormatKind::color, "FieldRendererSettings::colorFormat: format {} {}",
                 static_cast<int>(wanted.colorFormat), gpu::describe(kind));
    return given;
}

void FieldRenderer::Parts::requireFrame(VkCommandBuffer commands, const FrameSettings& wanted,
                                        double time, std::uint32_t slot) const
{
    requireUsage(commands != VK_NULL_HANDLE, "the command buffer is null");
    requireUsage(slot < slots.size(), "slot {}, and framesInFlight is {}", slot, slots.size());
    requireUsage(wanted.colliders.size() <= shared::maxColliders,
                 "{} colliders; a frame has at most {}", wanted.colliders.size(),
                 shared::maxColliders);
    requireValid(wanted);
    requireValidTime(time);
}

bool FieldRenderer::Parts::groupsDrawLarge() const
{
    return raster && targetSettings.groupsDrawLarge;
}

bool FieldRenderer::Parts::findsHidden(const FrameSettings& wanted) const
{
    // The visibility history belongs to the drawing camera only. Without the occlusion test hidden
    // blades count as drawn; the late pass drops them all the same, since this changes no picture.
    return groupsDrawLarge() && !wanted.cullingCamera && wanted.debug != DebugMode::reason;
}

gpu::ColorAttachment FieldRenderer::Parts::colorAttachment(const Target& target) const
{
    gpu::ColorAttachment color{
        .view = target.view, .resolve = VK_NULL_HANDLE, .clear = std::nullopt};
    if (attachments->hasColor())
        color.view = attachments->color().view();
    return color;
}

void FieldRenderer::Parts::drawOpaque(const gpu::Recording& commands, const Target& target,
                                      std::uint32_t slot, gpu::Timestamps* timestamps)
{
    const DispatchScope scope(context, commands, timestamps, "ground");
    const VkDeviceAddress frame = slots[slot].frame.place().address;
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::undefined,
                    gpu::ImageUse::depthTarget);
    opaque->recordCull(commands, frame);
    if (attachments->hasColor())
        gpu::transition(commands, attachments->color(), gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
    gpu::ColorAttachment color = colorAttachment(target);
    color.clear = std::array{0.0f, 0.0f, 0.0f, 1.0f};
    const gpu::DepthAttachment depth{.view = attachments->depth().view(), .clear = 0.0f};
    const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                        std::span(&color, 1), depth);
    opaque->record(commands, frame);
}

void FieldRenderer::Parts::rasterOpaque(const gpu::Recording& commands, std::uint32_t slot,
                                        gpu::Timestamps* timestamps)
{
    const DispatchScope scope(context, commands, timestamps, "ground");
    gpu::anythingToTransfer(commands);
    raster->recordBegin(commands);
    resolve->recordBegin(commands);
    opaqueRaster->recordBegin(commands);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::dispatchAccess);
    opaqueRaster->recordTriangles(commands, slots[slot].frame.place(), raster->visibility());
    gpu::computeToCompute(commands);
}

void FieldRenderer::Parts::seeWhatIsHidden(const gpu::Recording& commands, std::uint32_t slot,
                                           gpu::Timestamps* timestamps)
{
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
    {
        const DispatchScope scope(context, commands, timestamps, "pyramid");
        // The frame before may still read the pyramid.
        gpu::memoryBarrier(commands, gpu::computeAccess, gpu::computeAccess);
        pyramid.record(commands, slots[slot].frame.place().address);
    }
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::sampled,
                    gpu::ImageUse::depthTarget);
}

void FieldRenderer::Parts::seeWhatIsHidden(const gpu::Recording& commands,
                                           const ViewerRaster::Input& input,
                                           gpu::Timestamps* timestamps)
{
    {
        const DispatchScope scope(context, commands, timestamps, "pyramid");
        raster->recordDepths(commands, input);
    }
    gpu::computeToCompute(commands);
}

void FieldRenderer::Parts::drawBlades(const gpu::Recording& commands, const Target& target,
                                      std::uint32_t slot, gpu::Timestamps* timestamps)
{
    gpu::ColorAttachment color = colorAttachment(target);
    color.resolve = tessellated->begin(commands);
    color.isKept = color.resolve == VK_NULL_HANDLE;
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::depthTarget);
    gpu::transition(commands, attachments->hasColor() ? attachments->color().get() : target.image,
                    VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::colorTarget);
    const gpu::DepthAttachment depth{
        .view = attachments->depth().view(), .clear = std::nullopt, .isKept = false};

    const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                        std::span(&color, 1), depth);
    tessellated->record(commands, blades.buffers(), slots[slot].frame.place().address, timestamps);
}

void FieldRenderer::Parts::rasterBlades(const gpu::Recording& commands,
                                        const ViewerRaster::Input& input,
                                        gpu::Timestamps* timestamps)
{
    raster->recordRounds(commands, input, blades, rounds, timestamps);
}

void FieldRenderer::Parts::makePicture(const gpu::Recording& commands, const Target& target,
                                       std::uint32_t slot, const ViewerRaster::Input& input,
                                       gpu::Timestamps* timestamps)
{
    using gpu::ImageUse;
    const bool isStored = target.stored != VK_NULL_HANDLE;
    shared::RasterPush push = raster->pushFor(input);
    resolve->describe(push);
    gpu::computeToCompute(commands);
    {
        const DispatchScope scope(context, commands, timestamps, "ground");
        resolve->recordTiles(commands, push);
        opaqueRaster->recordLight(commands, input.frame, raster->visibility(), resolve->sorted());
    }
    const ImageUse filled = isStored ? ImageUse::storage : ImageUse::transferTarget;
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, ImageUse::colorTarget,
                    filled);
    gpu::computeToCompute(commands);
    resolve->aim(slot, target.stored);
    {
        const DispatchScope scope(context, commands, timestamps, "resolve");
        resolve->record(commands, push, input.frame, slot);
        if (!isStored)
            resolve->copyTo(commands, target.image);
    }
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, filled,
                    ImageUse::colorTarget);
}

} // namespace sward::render
