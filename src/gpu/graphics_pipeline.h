#pragma once

#include "gpu/context.h"
#include "gpu/pipeline_layout.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::gpu {

enum class Blend {
    off,
    alpha, ///< colour · alpha + what is there · (1 − alpha)
};

/// Vertices come from device addresses, so there is no vertex input; viewport and scissor are
/// dynamic.
struct GraphicsPipelineSettings {
    std::string name{}; ///< for debuggers

    std::string vertexShader{};                 ///< the name of its source
    std::string tessellationControlShader{};    ///< empty: none
    std::string tessellationEvaluationShader{}; ///< empty: none
    std::string fragmentShader{};               ///< empty: depth alone
    std::uint32_t patchControlPoints = 0;       ///< with tessellation: at least 1
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST; ///< without tessellation

    std::uint32_t pushConstantBytes = 0;             ///< of every stage
    std::vector<VkDescriptorSetLayout> setLayouts{}; ///< for images
    std::vector<SpecializationConstant> constants{}; ///< given to every stage

    std::vector<VkFormat> colorFormats{};         ///< of the attachments
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;   ///< undefined: no depth attachment
    VkFormat stencilFormat = VK_FORMAT_UNDEFINED; ///< of an attachment that is left alone
    std::uint32_t writtenColors = ~0u;            ///< bits; what is drawn leaves others alone
    VkRenderPass renderPass = VK_NULL_HANDLE;     ///< null: dynamic rendering
    std::uint32_t subpass = 0;                    ///< of the render pass
    std::uint32_t samples = 1;                    ///< a pixel

    bool depthTest = true;                            ///< with a depth attachment
    bool depthWrite = true;                           ///< where the test passes
    VkCompareOp depthCompare = VK_COMPARE_OP_GREATER; ///< reversed Z: near is 1

    VkCullModeFlags cullMode = VK_CULL_MODE_NONE;            ///< of faces
    VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE; ///< which side is in front
    VkPolygonMode polygonMode = VK_POLYGON_MODE_FILL; ///< lines: the device needs `wireframe`
    Blend blend = Blend::off;                         ///< with what is there
};

/// A pipeline that draws. Must outlive the commands that were recorded with it.
class GraphicsPipeline {
public:
    GraphicsPipeline() = default;

    /// Throws Error{runtime} or Error{unsupported} where the device cannot.
    GraphicsPipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                     const GraphicsPipelineSettings& settings);

    VkPipeline get() const { return pipeline_.get(); }       ///< the handle
    const PipelineLayout& layout() const { return layout_; } ///< of all its shaders

    void bind(const Recording& commands) const; ///< for what is drawn from here on

    /// Gives its shaders their constants, `pushConstantBytes` of them.
    template <typename T>
    void push(const Recording& commands, const T& constants) const
    {
        layout_.push(commands, constants);
    }

private:
    PipelineLayout layout_;
    Pipeline pipeline_;
};

} // namespace sward::gpu
