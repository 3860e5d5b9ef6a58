#include "render/blade_target.h"

#include "core/embedded.h"
#include "core/expect.h"
#include "gpu/shader_library.h"
#include "render/blade_pass.h"
#include "shaders/shared/passes.h"

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

// To whom lighting.glsl hands the picture.
constexpr std::uint32_t toHost = 1;
constexpr std::uint32_t toHostFilm = 2;
constexpr std::uint32_t toNobody = 3;

gpu::GraphicsPipelineSettings pipelineFor(const HostTarget& target)
{
    gpu::GraphicsPipelineSettings settings = tessellatedBlades();
    settings.colorFormats = target.colorFormats;
    settings.writtenColors = target.writesMotion ? 3 : 1;
    settings.depthFormat = target.depthFormat;
    settings.stencilFormat = target.stencilFormat;
    settings.renderPass = target.renderPass;
    settings.subpass = target.subpass;
    settings.samples = target.samples;
    settings.depthCompare = target.hasReversedZ ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    settings.constants = {{.id = 9, .value = target.keepsRadiance ? toHostFilm : toHost}};
    if (target.writesMotion) {
        expect(target.colorFormats.size() >= 2, "motion has an attachment");
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
        settings.constants = {{.id = 9, .value = toNobody}};
    }
    return settings;
}

} // namespace

BladeTarget::BladeTarget(const gpu::DeviceContext& context, const HostTarget& target)
    : settings_(target)
    , pipeline_(context, gpu::ShaderLibrary(embedded::shaders()), pipelineFor(target))
{
}

} // namespace sward::render
