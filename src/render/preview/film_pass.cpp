#include "render/preview/film_pass.h"

#include "gpu/memory/image_use.h"
#include "gpu/recording/rendering.h"
#include "render/frame/shader_names.h"

#include <optional>
#include <span>

namespace sward::render {

FilmPass::FilmPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                   const TargetSettings& target)
    : context_(&context)
    , format_(target.colorFormat)
    , imageLayout_(
          context,
          {.name = "film/resolved", .sampledCount = 1, .stages = VK_SHADER_STAGE_FRAGMENT_BIT})
    , sampler_(gpu::createSampler(context, {.name = "film",
                                            .filter = VK_FILTER_NEAREST,
                                            .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}))
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "film";
    settings.vertexShader = shader::filmVertex;
    settings.fragmentShader = shader::filmFragment;
    settings.setLayouts = {imageLayout_.get()};
    settings.colorFormats = {target.colorFormat};
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void FilmPass::resize(glm::uvec2 size)
{
    resolved_ = gpu::Image(
        *context_, {.name = "frame/resolved",
                    .format = format_,
                    .extent = {size.x, size.y},
                    .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    images_ = gpu::ImageSet(*context_, imageLayout_, "film/resolved");
    images_.setSampled(0, resolved_.view(), sampler_.get());
}

VkImageView FilmPass::begin(const gpu::Recording& commands) const
{
    gpu::transition(commands, resolved_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
    return resolved_.view();
}

void FilmPass::record(const gpu::Recording& commands, VkImageView target) const
{
    gpu::transition(commands, resolved_, gpu::ImageUse::colorTarget, gpu::ImageUse::sampled);
    const gpu::ColorAttachment color{.view = target, .clear = std::nullopt};
    const gpu::RenderingScope rendering(commands, resolved_.extent(), std::span(&color, 1));
    pipeline_.bind(commands);
    images_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.layout());
    commands.vk->CmdDraw(commands, 3, 1, 0, 0);
}

} // namespace sward::render
