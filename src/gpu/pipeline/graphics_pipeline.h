#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/pipeline_layout.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::gpu {

enum class Blend {
    off,
    alpha, ///< colour · alpha + destination · (1 − alpha)
};

/// Shaders fetch vertices by device address, so there is no vertex input. Viewport and scissor are
/// dynamic.
struct GraphicsPipelineSettings {
    std::string name{}; ///< for debuggers

    std::string vertexShader{};                 ///< name in the ShaderLibrary
    std::string tessellationControlShader{};    ///< empty: none
    std::string tessellationEvaluationShader{}; ///< empty: none
    std::string fragmentShader{};               ///< empty: only depth
    std::uint32_t patchControlPoints = 0;       ///< with tessellation: at least 1
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST; ///< without tessellation

    std::uint32_t pushConstantBytes = 0;             ///< of every stage
    std::vector<VkDescriptorSetLayout> setLayouts{}; ///< for images
    std::vector<SpecializationConstant> constants{}; ///< given to every stage

    std::vector<VkFormat> colorFormats{};         ///< of the attachments
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;   ///< undefined: no depth attachment
    VkFormat stencilFormat = VK_FORMAT_UNDEFINED; ///< of an attachment that stays unchanged
    std::uint32_t writtenColors = ~0u;            ///< bit mask; other attachments stay unchanged
    VkRenderPass renderPass = VK_NULL_HANDLE;     ///< null: dynamic rendering
    std::uint32_t subpass = 0;                    ///< of the render pass
    std::uint32_t samples = 1;                    ///< per pixel

    bool depthTest = true;                            ///< needs a depth attachment
    bool depthWrite = true;                           ///< if the test passes
    VkCompareOp depthCompare = VK_COMPARE_OP_GREATER; ///< reversed Z: near is 1

    VkCullModeFlags cullMode = VK_CULL_MODE_NONE;            ///< of faces
    VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE; ///< winding of front faces
    VkPolygonMode polygonMode = VK_POLYGON_MODE_FILL; ///< lines: the device needs `wireframe`
    Blend blend = Blend::off;                         ///< with the destination
};

/// A graphics pipeline. Must outlive the commands that use it.
class GraphicsPipeline {
public:
    GraphicsPipeline() = default;

    /// Throws Error{runtime} or Error{unsupported} if the device cannot create it.
    GraphicsPipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                     const GraphicsPipelineSettings& settings);

    /// The handle; null if default-constructed.
    VkPipeline get() const { return pipeline_ ? pipeline_->get() : VK_NULL_HANDLE; }
    const PipelineLayout& layout() const { return layout_; } ///< of all its shaders

    void bind(const Recording& commands) const; ///< for the draws recorded next

    /// Sets the push constants of its shaders; exactly `pushConstantBytes` bytes.
    template <typename T>
    void push(const Recording& commands, const T& constants) const
    {
        layout_.push(commands, constants);
    }

private:
    PipelineLayout layout_;
    std::shared_ptr<const Pipeline> pipeline_;
};

} // namespace sward::gpu
