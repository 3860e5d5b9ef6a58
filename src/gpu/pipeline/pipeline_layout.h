#pragma once

#include "core/expect.h"
#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace sward::gpu {

using Pipeline = Owned<VkPipeline, &DeviceFunctions::DestroyPipeline>;

/// The minimum that Vulkan guarantees, and the limit of lavapipe.
constexpr std::uint32_t maxPushConstantBytes = 128;

/// Inputs of a pipeline's shaders: push constants, and descriptor sets for images. Buffers are
/// passed as addresses inside the push constants.
class PipelineLayout {
public:
    PipelineLayout() = default;
    PipelineLayout(const DeviceContext& context, const std::string& name, VkShaderStageFlags stages,
                   std::uint32_t pushConstantBytes,
                   std::span<const VkDescriptorSetLayout> setLayouts);

    VkPipelineLayout get() const { return layout_.get(); }

    /// The size of `constants` must equal the layout's push constant bytes.
    template <typename T>
    void push(const Recording& commands, const T& constants) const
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= maxPushConstantBytes);
        expect(sizeof(T) == pushConstantBytes_, "the push constants have the pipeline's size");
        commands.vk->CmdPushConstants(commands, layout_.get(), stages_, 0, pushConstantBytes_,
                                      &constants);
    }

private:
    Owned<VkPipelineLayout, &DeviceFunctions::DestroyPipelineLayout> layout_;
    VkShaderStageFlags stages_ = 0;
    std::uint32_t pushConstantBytes_ = 0;
};

/// A 32-bit constant of a shader; a float by std::bit_cast, a bool as 0 or 1.
struct SpecializationConstant {
    std::uint32_t id = 0;
    std::uint32_t value = 0;
};

/// Specialisation constants in Vulkan's form; holds pointers to `constants` and to itself.
class Specialization {
public:
    explicit Specialization(std::span<const SpecializationConstant> constants);
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;

    const VkSpecializationInfo* get() const { return entries_.empty() ? nullptr : &constants_; }

private:
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo constants_{};
};

} // namespace sward::gpu
