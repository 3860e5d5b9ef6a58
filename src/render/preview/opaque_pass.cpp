#include "render/preview/opaque_pass.h"

namespace sward::render {

OpaquePass::OpaquePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       const TargetSettings& target, const GroundBuffers& ground)
    : context_(&context)
    , ground_(&ground)
    , target_(target)
    , cull_(context, shaders, ground)
    , plain_(context, shaders, target, ground.imageLayout())
{
}

void OpaquePass::prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders,
                         bool paintsWind)
{
    colliderCount_ = colliders;
    paintsWind_ = paintsWind;
    if (colliders > 0 && colliders_ == nullptr)
        colliders_ = std::make_unique<ColliderPass>(*context_, shaders, target_);
    if (paintsWind && windy_ == nullptr) {
        TargetSettings target = target_;
        target.debugMode = shared::debugWind;
        windy_ = std::make_unique<GroundPass>(*context_, shaders, target, ground_->imageLayout());
    }
}

void OpaquePass::recordCull(const gpu::Recording& commands, VkDeviceAddress frame) const
{
    cull_.record(commands, frame);
}

void OpaquePass::record(const gpu::Recording& commands, VkDeviceAddress frame) const
{
    (paintsWind_ ? *windy_ : plain_).record(commands, *ground_, cull_, frame);
    if (colliderCount_ > 0)
        colliders_->record(commands, frame, colliderCount_);
}

} // namespace sward::render
