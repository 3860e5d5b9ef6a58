#include "render/tessellation/blade_target.h"

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/memory/format_kind.h"
#include "gpu/pipeline/shader_library.h"
#include "render/frame/shader_names.h"
#include "render/host/host_shadow_maps.h"
#include "render/tessellation/blade_pass.h"
#include "render/tessellation/blade_target_parts.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

#include <memory>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

/// Sets the common state of a target's pipelines.
void setTarget(gpu::GraphicsPipelineSettings& settings, const HostTarget& target)
{
    settings.colorFormats = target.colorFormats;
    settings.writtenColors = target.writesMotion ? 3 : 1;
    settings.depthFormat = target.depthFormat;
    settings.stencilFormat = target.stencilFormat;
    settings.renderPass = target.renderPass;
    settings.subpass = target.subpass;
    settings.samples = target.samples;
    settings.depthCompare = target.hasReversedZ ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    const std::uint32_t output = target.colorFormats.empty() ? shared::outputNone
                                 : target.keepsRadiance      ? shared::outputRadiance
                                                             : shared::outputHost;
    settings.constants = {{.id = shared::idOutputMode, .value = output}};
}

using gpu::FormatKind;

/// Colours hold what blades write: light in the first, motion in the second. Of others, which stay
/// as they are, none is a depth.
void requireColors(const HostTarget& target)
{
    for (std::size_t i = 0; i < target.colorFormats.size(); ++i) {
        const VkFormat format = target.colorFormats[i];
        const FormatKind kind = gpu::formatKind(format);
        const bool isWritten = i == 0 || (i == 1 && target.writesMotion);
        const bool isFit = isWritten ? kind == FormatKind::color
                                     : kind != FormatKind::depth && kind != FormatKind::stencil;
        requireUsage(isFit, "HostTarget::colorFormats: format {} of attachment {} {}{}",
                     static_cast<int>(format), i, gpu::describe(kind),
                     isWritten ? ", and blades write fractions" : "");
    }
}

void requireDepth(const HostTarget& target)
{
    const FormatKind kind = gpu::formatKind(target.depthFormat);
    requireUsage(!target.colorFormats.empty() || kind != FormatKind::undefined,
                 "HostTarget: there is neither a colour nor a depth to draw into");
    requireUsage(kind == FormatKind::undefined || kind == FormatKind::depth,
                 "HostTarget::depthFormat: format {} has no depth, it {}",
                 static_cast<int>(target.depthFormat), gpu::describe(kind));
    const int stencil = static_cast<int>(target.stencilFormat);
    requireUsage(stencil == VK_FORMAT_UNDEFINED || gpu::hasStencil(target.stencilFormat),
                 "HostTarget::stencilFormat: format {} has no stencil", stencil);
    requireUsage(stencil == VK_FORMAT_UNDEFINED || kind == FormatKind::undefined ||
                     target.depthFormat == target.stencilFormat,
                 "HostTarget::stencilFormat is {}, and depthFormat is {}: one image has both",
                 stencil, static_cast<int>(target.depthFormat));
}

const HostTarget& checkedTarget(const gpu::DeviceContext& context, const HostTarget& target)
{
    gpu::requireDevice(context);
    const std::size_t colors = target.colorFormats.size();
    requireUsage(colors <= context.limits.maxColorAttachments,
                 "HostTarget::colorFormats: {}, and the device draws into {} at once", colors,
                 context.limits.maxColorAttachments);
    requireUsage(!target.writesMotion || colors >= 2,
                 "HostTarget::writesMotion needs a second colour, and there are {}", colors);
    requireColors(target);
    requireDepth(target);
    const std::uint32_t samples = target.samples;
    requireUsage(samples == 1 || samples == 2 || samples == 4 || samples == 8,
                 "HostTarget::samples is {}, not 1, 2, 4 or 8", samples);
    if ((colors > 0 && (context.limits.framebufferColorSampleCounts & samples) == 0) ||
        (context.limits.framebufferDepthSampleCounts & samples) == 0)
        fail(ErrorKind::unsupported, "HostTarget::samples is {}, which the device does not draw",
             samples);
    return target;
}

bool mayShowVisibility(const gpu::DeviceContext& context, const HostTarget& target)
{
    return context.features.bufferInt64Atomics &&
           (target.samples == 1 || (target.samples == 4 && context.features.sampleRateShading));
}

gpu::GraphicsPipelineSettings visibilityPipelineFor(const HostTarget& target)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "blades/visibility";
    settings.vertexShader = shader::drawVisibilityVertex;
    if (target.writesMotion)
        settings.fragmentShader =
            target.samples > 1 ? shader::drawVisibilityMotionOfFour : shader::drawVisibilityMotion;
    else
        settings.fragmentShader =
            target.samples > 1 ? shader::drawVisibilityOfFour : shader::drawVisibility;
    settings.pushConstantBytes = sizeof(shared::HostViewPush);
    setTarget(settings, target);
    settings.constants.push_back({.id = shared::idSamplesPerPixel, .value = target.samples});
    settings.constants.push_back(
        {.id = shared::idHasForwardZ, .value = target.hasReversedZ ? 0u : 1u});
    return settings;
}

gpu::GraphicsPipelineSettings pipelineFor(const HostTarget& target, bool hasHostLight)
{
    gpu::GraphicsPipelineSettings settings = tessellatedBlades();
    setTarget(settings, target);
    settings.constants.push_back({.id = shared::idWritesMotion, .value = target.writesMotion});
    if (target.writesMotion)
        settings.name = "blades/motion";
    if (target.colorFormats.empty()) {
        settings.name = "blades/depth";
        settings.fragmentShader = shader::bladeDepthFragment;
        return settings;
    }
    settings.fragmentShader =
        target.writesMotion ? shader::bladeHostMotionFragment : shader::bladeHostFragment;
    settings.constants.push_back({.id = shared::idHasHostLight, .value = hasHostLight});
    if (hasHostLight)
        settings.name += "/host light";
    return settings;
}

gpu::GraphicsPipeline makePipeline(const gpu::DeviceContext& context, const HostTarget& target,
                                   bool hasHostLight)
{
    gpu::GraphicsPipelineSettings settings = pipelineFor(target, hasHostLight);
    // A pipeline keeps what it needs of the layout.
    const gpu::ImageSetLayout shadows = hostShadowLayout(context);
    if (!target.colorFormats.empty())
        settings.setLayouts = {shadows.get()};
    return {context, gpu::ShaderLibrary(embedded::shaders()), settings};
}

} // namespace

BladeTarget::Parts::Parts(const gpu::DeviceContext& context, const HostTarget& target)
    : tessellated(makePipeline(context, target, false))
{
    if (!target.colorFormats.empty())
        hostLight = makePipeline(context, target, true);
    if (mayShowVisibility(context, target))
        visibility.emplace(context, gpu::ShaderLibrary(embedded::shaders()),
                           visibilityPipelineFor(target));
}

BladeTarget::BladeTarget(const gpu::DeviceContext& context, const HostTarget& target)
    : device_(context.device)
    , settings_(checkedTarget(context, target))
    , parts_(std::make_shared<const Parts>(context, target))
{
}

} // namespace sward::render
