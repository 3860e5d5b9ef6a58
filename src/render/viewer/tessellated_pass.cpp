#include "render/viewer/tessellated_pass.h"

#include "render/cull/pass_scope.h"

namespace sward::render {

TessellatedPass::TessellatedPass(const gpu::DeviceContext& context,
                                 const gpu::ShaderLibrary& shaders, const TargetSettings& target)
    : context_(&context)
    , target_(target)
    , blades_(context, shaders, target)
    , sky_(context, shaders, target)
{
    if (target.samples > 1)
        film_.emplace(context, shaders, target);
}

void TessellatedPass::resize(glm::uvec2 size)
{
    if (film_)
        film_->resize(size);
}

void TessellatedPass::prepare(const gpu::ShaderLibrary& shaders, bool paintsWind)
{
    paintsWind_ = paintsWind;
    if (!paintsWind || windy_)
        return;
    TargetSettings target = target_;
    target.debugMode = shared::debugWind;
    windy_.emplace(*context_, shaders, target);
}

VkImageView TessellatedPass::begin(const gpu::Recording& commands) const
{
    return film_ ? film_->begin(commands) : VK_NULL_HANDLE;
}

void TessellatedPass::record(const gpu::Recording& commands, const VisibleBlades* list,
                             VkDeviceAddress frame, gpu::Timestamps* timestamps) const
{
    if (list != nullptr) {
        const PassScope scope(*context_, commands, timestamps, "blades");
        (paintsWind_ ? *windy_ : blades_).record(commands, *list, frame);
    }
    const PassScope scope(*context_, commands, timestamps, "sky");
    sky_.record(commands, frame);
}

void TessellatedPass::finish(const gpu::Recording& commands, VkImageView target) const
{
    if (film_)
        film_->record(commands, target);
}

} // namespace sward::render
