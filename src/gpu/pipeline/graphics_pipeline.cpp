#include "gpu/pipeline/graphics_pipeline.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/pipeline/shared_objects.h"

namespace sward::gpu {
namespace {

// The modules of a pipeline in Vulkan's form; destroyed once the pipeline is made.
struct Stages {
    std::vector<ShaderModule> modules;
    std::vector<VkPipelineShaderStageCreateInfo> stages;

    void add(const DeviceContext& context, const ShaderLibrary& shaders, const std::string& name,
             VkShaderStageFlagBits stage, const Specialization& specialization)
    {
        if (name.empty())
            return;
        modules.push_back(shaders.module(context, name));
        VkPipelineShaderStageCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        create.stage = stage;
        create.module = modules.back().get();
        create.pName = "main";
        create.pSpecializationInfo = specialization.get();
        stages.push_back(create);
    }
};

VkPipelineColorBlendAttachmentState blending(Blend blend)
{
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    if (blend == Blend::alpha) {
        state.blendEnable = VK_TRUE;
        state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        state.colorBlendOp = VK_BLEND_OP_ADD;
        state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
        state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        state.alphaBlendOp = VK_BLEND_OP_ADD;
    }
    return state;
}

void expectSound(const DeviceContext& context, const GraphicsPipelineSettings& settings)
{
    const bool controls = !settings.tessellationControlShader.empty();
    const bool evaluates = !settings.tessellationEvaluationShader.empty();
    expect(!settings.vertexShader.empty(), "a graphics pipeline has a vertex shader");
    expect(controls == evaluates, "tessellation has a control and an evaluation shader");
    expect(controls == (settings.patchControlPoints > 0), "tessellation has control points");
    expect(settings.polygonMode == VK_POLYGON_MODE_FILL || context.features.wireframe,
           "the device draws lines instead of faces");
}

ObjectKey keyOf(const GraphicsPipelineSettings& settings, const ShaderLibrary& shaders)
{
    ObjectKey key;
    key.add(VK_PIPELINE_BIND_POINT_GRAPHICS);
    for (const std::string* name :
         {&settings.vertexShader, &settings.tessellationControlShader,
          &settings.tessellationEvaluationShader, &settings.fragmentShader}) {
        key.add(name->empty());
        if (!name->empty())
            shaders.addTo(key, *name);
    }
    key.add(settings.patchControlPoints)
        .add(settings.topology)
        .add(settings.pushConstantBytes)
        .add(std::span(settings.setLayouts))
        .add(std::span(settings.constants))
        .add(std::span(settings.colorFormats))
        .add(settings.depthFormat)
        .add(settings.stencilFormat)
        .add(settings.writtenColors)
        .add(settings.samples)
        .add(settings.depthTest)
        .add(settings.depthWrite)
        .add(settings.depthCompare)
        .add(settings.cullMode)
        .add(settings.frontFace)
        .add(settings.polygonMode)
        .add(settings.blend);
    return key;
}

VkPipeline createPipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                          const GraphicsPipelineSettings& settings, VkPipelineLayout layout)
{
    const bool tessellates = settings.patchControlPoints > 0;
    const bool hasDepth = settings.depthFormat != VK_FORMAT_UNDEFINED;

    const Specialization specialization(settings.constants);
    Stages stages;
    stages.add(context, shaders, settings.vertexShader, VK_SHADER_STAGE_VERTEX_BIT, specialization);
    stages.add(context, shaders, settings.tessellationControlShader,
               VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT, specialization);
    stages.add(context, shaders, settings.tessellationEvaluationShader,
               VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT, specialization);
    stages.add(context, shaders, settings.fragmentShader, VK_SHADER_STAGE_FRAGMENT_BIT,
               specialization);

    VkPipelineVertexInputStateCreateInfo vertexInput{};
    vertexInput.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = tessellates ? VK_PRIMITIVE_TOPOLOGY_PATCH_LIST : settings.topology;

    VkPipelineTessellationStateCreateInfo tessellation{};
    tessellation.sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO;
    tessellation.patchControlPoints = settings.patchControlPoints;

    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = settings.polygonMode;
    raster.cullMode = settings.cullMode;
    raster.frontFace = settings.frontFace;
    raster.lineWidth = 1.0f;

    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(settings.samples);

    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = hasDepth && settings.depthTest ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = hasDepth && settings.depthWrite ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = settings.depthCompare;

    std::vector<VkPipelineColorBlendAttachmentState> attachments(settings.colorFormats.size(),
                                                                 blending(settings.blend));
    for (std::size_t i = 0; i < attachments.size(); ++i)
        if ((settings.writtenColors >> i & 1u) == 0)
            attachments[i] = {};
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    blend.pAttachments = attachments.data();

    constexpr VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT,
                                                VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamicStates;

    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(settings.colorFormats.size());
    rendering.pColorAttachmentFormats = settings.colorFormats.data();
    rendering.depthAttachmentFormat = settings.depthFormat;
    rendering.stencilAttachmentFormat = settings.stencilFormat;

    VkGraphicsPipelineCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    create.pNext = settings.renderPass == VK_NULL_HANDLE ? &rendering : nullptr;
    create.renderPass = settings.renderPass;
    create.subpass = settings.subpass;
    create.stageCount = static_cast<std::uint32_t>(stages.stages.size());
    create.pStages = stages.stages.data();
    create.pVertexInputState = &vertexInput;
    create.pInputAssemblyState = &assembly;
    create.pTessellationState = tessellates ? &tessellation : nullptr;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &samples;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
    create.layout = layout;

    VkPipeline pipeline = VK_NULL_HANDLE;
    check(context.vk.CreateGraphicsPipelines(context.device, context.pipelineCache, 1, &create,
                                             context.allocation, &pipeline),
          "vkCreateGraphicsPipelines");
    setName(context, pipeline, settings.name);
    return pipeline;
}

} // namespace

GraphicsPipeline::GraphicsPipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                                   const GraphicsPipelineSettings& settings)
    : layout_(context, settings.name, VK_SHADER_STAGE_ALL_GRAPHICS, settings.pushConstantBytes,
              settings.setLayouts)
{
    expectSound(context, settings);
    const auto make = [&](const DeviceContext& owner) {
        return Pipeline(owner, createPipeline(owner, shaders, settings, layout_.get()));
    };
    // The handle of a host's render pass does not tell what it is.
    pipeline_ = settings.renderPass == VK_NULL_HANDLE
                    ? madeOnce<Pipeline>(context, keyOf(settings, shaders), make)
                    : std::make_shared<const Pipeline>(make(context));
}

void GraphicsPipeline::bind(const Recording& commands) const
{
    commands.vk->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, get());
}

} // namespace sward::gpu
