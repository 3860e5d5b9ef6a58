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
    if (isStreamed())
        fail(ErrorKind::unsupported, "a field that is larger than its budget of device memory "
                                     "cannot be edited while it is shown");
    requireUsage(parts.field->isEditable(), "FieldRendererSettings::isEditable is not set");
    parts.field->apply(delta);
    if (parts.field->edits == nullptr)
        return;
    parts.field->edits->begin();
    parts.blades->followEdits();
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
    requireUsage(!wanted.keepsRadiance || wanted.colorFormat == VK_FORMAT_R16G16B16A16_SFLOAT,
                 "FieldRendererSettings::keepsRadiance: colorFormat is {}, not "
                 "VK_FORMAT_R16G16B16A16_SFLOAT ({})",
                 static_cast<int>(wanted.colorFormat),
                 static_cast<int>(VK_FORMAT_R16G16B16A16_SFLOAT));
    return given;
}

gpu::Recording FieldRenderer::Parts::recording(VkCommandBuffer commands,
                                               const FrameSettings& wanted, double time,
                                               std::uint32_t slot) const
{
    requireUsage(commands != VK_NULL_HANDLE, "the command buffer is null");
    requireUsage(slot < settings.framesInFlight, "slot {}, and framesInFlight is {}", slot,
                 settings.framesInFlight);
    requireUsage(wanted.colliders.size() <= shared::maxColliders,
                 "{} colliders; a frame has at most {}", wanted.colliders.size(),
                 shared::maxColliders);
    requireValid(wanted);
    requireValidTime(time);
    return {context, commands};
}

gpu::ColorAttachment FieldRenderer::Parts::colorAttachment(const Target& target) const
{
    gpu::ColorAttachment color{
        .view = target.view, .resolve = VK_NULL_HANDLE, .clear = std::nullopt};
    if (attachments->hasColor())
        color.view = attachments->color().view();
    return color;
}

/// Draws the opaque scene by the graphics pipeline, and lets the depth pyramid read its depth.
void FieldRenderer::Parts::drawOpaque(const gpu::Recording& commands, const Target& target,
                                      gpu::Timestamps* timestamps)
{
    {
        const DispatchScope scope(context, commands, timestamps, "ground");
        gpu::transition(commands, attachments->depth(), gpu::ImageUse::undefined,
                        gpu::ImageUse::depthTarget);
        opaque->recordCull(commands, frame().address);
        if (attachments->hasColor())
            gpu::transition(commands, attachments->color(), gpu::ImageUse::undefined,
                            gpu::ImageUse::colorTarget);
        gpu::ColorAttachment color = colorAttachment(target);
        color.clear = std::array{0.0f, 0.0f, 0.0f, 1.0f};
        const gpu::DepthAttachment depth{.view = attachments->depth().view(), .clear = 0.0f};
        const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                            std::span(&color, 1), depth);
        opaque->record(commands, frame().address);
    }
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
}

void FieldRenderer::Parts::drawBlades(const gpu::Recording& commands, const Target& target,
                                      gpu::Timestamps* timestamps)
{
    gpu::computeToDraw(commands);
    gpu::ColorAttachment color = colorAttachment(target);
    color.resolve = tessellated->begin(commands);
    color.isKept = color.resolve == VK_NULL_HANDLE;
    gpu::transition(commands, attachments->depth(), gpu::ImageUse::sampled,
                    gpu::ImageUse::depthTarget);
    gpu::transition(commands, attachments->hasColor() ? attachments->color().get() : target.image,
                    VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::colorTarget);
    const gpu::DepthAttachment depth{
        .view = attachments->depth().view(), .clear = std::nullopt, .isKept = false};

    const gpu::RenderingScope rendering(commands, {target.size.x, target.size.y},
                                        std::span(&color, 1), depth);
    const bool hasBlades = blades->blades().bladeCount() > 0;
    tessellated->record(commands, hasBlades ? &blades->list(0) : nullptr, frame().address,
                        timestamps);
}

/// Lights and resolves the visibility of ground and blades into the target.
void FieldRenderer::Parts::makePicture(const gpu::Recording& commands, const Target& target,
                                       gpu::Timestamps* timestamps)
{
    using gpu::ImageUse;
    const bool isStored = target.stored != VK_NULL_HANDLE;
    shared::RasterPush push = recorder.raster.pushOf(recorder.slot, 0);
    resolve->describe(push);
    {
        const DispatchScope scope(context, commands, timestamps, "ground");
        resolve->recordTiles(commands, push);
        opaqueRaster->recordLight(commands, frame(), push.visibility, resolve->sorted());
    }
    // The resolve clears the visibility.
    if (target.layers != 0)
        recordLayers(commands, target, push, timestamps);
    const ImageUse filled = isStored ? ImageUse::storage : ImageUse::transferTarget;
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, ImageUse::colorTarget,
                    filled);
    gpu::computeToCompute(commands);
    resolve->aim(recorder.slot, target.stored);
    {
        const DispatchScope scope(context, commands, timestamps, "resolve");
        resolve->record(commands, push, frame(), recorder.slot);
        if (!isStored)
            resolve->copyTo(commands, target.image);
    }
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, filled,
                    ImageUse::colorTarget);
}

} // namespace sward::render
