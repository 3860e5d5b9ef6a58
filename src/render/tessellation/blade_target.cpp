#include "render/tessellation/blade_target.h"

#include "core/embedded.h"
#include "core/expect.h"
#include "gpu/shader_library.h"
#include "render/host_shadow_maps.h"
#include "render/tessellation/blade_pass.h"
#include "shaders/shared/passes.h"

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

// Output modes of lighting.glsl.
constexpr std::uint32_t toHost = 1;
constexpr std::uint32_t toHostFilm = 2;
constexpr std::uint32_t toNone = 3;

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
    const std::uint32_t handedTo = target.colorFormats.empty() ? toNone
                                   : target.keepsRadiance      ? toHostFilm
                                                               : toHost;
    settings.constants = {{.id = 9, .value = handedTo}};
    if (target.writesMotion)
        expect(target.colorFormats.size() >= 2, "motion has an attachment");
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
    settings.vertexShader = "draw_visibility.vert";
    if (target.writesMotion)
        settings.fragmentShader = target.samples > 1 ? "draw_visibility_motion_of_four.frag"
                                                     : "draw_visibility_motion.frag";
    else
        settings.fragmentShader =
            target.samples > 1 ? "draw_visibility_of_four.frag" : "draw_visibility.frag";
    settings.pushConstantBytes = sizeof(shared::HostViewPush);
    setTarget(settings, target);
    settings.constants.push_back({.id = 1, .value = target.samples});
    settings.constants.push_back({.id = 16, .value = target.hasReversedZ ? 0u : 1u});
    return settings;
}

gpu::GraphicsPipelineSettings pipelineFor(const HostTarget& target)
{
    gpu::GraphicsPipelineSettings settings = tessellatedBlades();
    setTarget(settings, target);
    if (target.writesMotion) {
        settings.name = "blades/motion";
        settings.vertexShader = "blade_motion.vert";
        settings.tessellationControlShader = "blade_motion.tesc";
        settings.tessellationEvaluationShader = "blade_motion.tese";
        settings.fragmentShader = "blade_motion.frag";
        settings.pushConstantBytes = sizeof(shared::MotionPush);
    }
    if (target.colorFormats.empty()) {
        settings.name = "blades/depth";
        settings.fragmentShader = "blade_depth.frag";
    }
    return settings;
}

} // namespace

BladeTarget::BladeTarget(const gpu::DeviceContext& context, const HostTarget& target)
    : settings_(target)
    , pipeline_(context, gpu::ShaderLibrary(embedded::shaders()), pipelineFor(target))
{
    if (!target.colorFormats.empty()) {
        // A pipeline keeps what it needs of the layout.
        const gpu::ImageSetLayout shadows = hostShadowLayout(context);
        gpu::GraphicsPipelineSettings settings = pipelineFor(target);
        settings.name += "/host light";
        settings.fragmentShader =
            target.writesMotion ? "blade_motion_host_light.frag" : "blade_host_light.frag";
        settings.setLayouts = {shadows.get()};
        hostLight_ =
            gpu::GraphicsPipeline(context, gpu::ShaderLibrary(embedded::shaders()), settings);
    }
    if (mayShowVisibility(context, target))
        visibility_.emplace(context, gpu::ShaderLibrary(embedded::shaders()),
                            visibilityPipelineFor(target));
}

} // namespace sward::render
