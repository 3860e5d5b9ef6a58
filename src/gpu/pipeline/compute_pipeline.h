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

struct ComputePipelineSettings {
    std::string name{};
    std::string shader{}; ///< name in the ShaderLibrary
    std::uint32_t pushConstantBytes = 0;
    std::vector<VkDescriptorSetLayout> setLayouts{};
    std::vector<SpecializationConstant> constants{};
    bool isExact = false; ///< its results are the same on every device: see withoutContraction()
};

class ComputePipeline {
public:
    ComputePipeline() = default;
    ComputePipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                    const ComputePipelineSettings& settings);

    VkPipeline get() const { return pipeline_ ? pipeline_->get() : VK_NULL_HANDLE; }
    const PipelineLayout& layout() const { return layout_; }

    void bind(const Recording& commands) const;

    template <typename T>
    void push(const Recording& commands, const T& constants) const
    {
        layout_.push(commands, constants);
    }

private:
    PipelineLayout layout_;
    std::shared_ptr<const Pipeline> pipeline_;
};

/// Work-groups in x and y, together at least `groups`, within the device's limit per dimension (65
/// 535 on lavapipe). The shader computes its index as `gl_WorkGroupID.y * gl_NumWorkGroups.x +
/// gl_WorkGroupID.x` and returns if that is not below `groups`.
VkExtent2D groupGrid(const DeviceContext& context, std::uint64_t groups);

/// ⌈count / size⌉
constexpr std::uint64_t groupsFor(std::uint64_t count, std::uint64_t size)
{
    return (count + size - 1) / size;
}

} // namespace sward::gpu
