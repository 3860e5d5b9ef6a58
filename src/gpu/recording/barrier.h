#pragma once

#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

namespace sward::gpu {

// Named barriers between passes. Commands recorded before have completed and their writes are
// visible when later ones begin; this includes waiting for earlier readers. They cover buffers;
// images also change layout (image_use.h).

struct Access {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 accesses;
};

constexpr VkPipelineStageFlags2 shaderStages =
    VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 readAndWrite = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

constexpr Access anyAccess{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, readAndWrite};
constexpr Access transferAccess{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Access computeAccess{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                               VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
/// Clear, fill or copy, and concurrent compute shaders.
constexpr Access fillAccess{
    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
constexpr Access drawAccess{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
                                VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT,
                            VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT |
                                VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
constexpr Access dispatchAccess{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
                                    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT |
                                    VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
constexpr Access hostAccess{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
constexpr Access hostOrDispatchAccess{hostAccess.stages | dispatchAccess.stages,
                                      hostAccess.accesses | dispatchAccess.accesses};

inline void memoryBarrier(const Recording& commands, const Access& before, const Access& after)
{
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = before.stages;
    barrier.srcAccessMask = before.accesses;
    barrier.dstStageMask = after.stages;
    barrier.dstAccessMask = after.accesses;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    commands.vk->CmdPipelineBarrier2(commands, &dependency);
}

/// Any access → clear, fill or copy: the first barrier of a frame that reuses its lists.
inline void anythingToTransfer(const Recording& commands)
{
    memoryBarrier(commands, anyAccess, transferAccess);
}

/// Clear, fill or copy → compute shaders.
inline void transferToCompute(const Recording& commands)
{
    memoryBarrier(commands, transferAccess, computeAccess);
}

/// Compute → compute shaders, indirect dispatch included.
inline void computeToCompute(const Recording& commands)
{
    memoryBarrier(commands, computeAccess, dispatchAccess);
}

/// Compute → indirect arguments, indices, and what the stages of a draw read.
inline void computeToDraw(const Recording& commands)
{
    memoryBarrier(commands, computeAccess, drawAccess);
}

/// Compute → copy.
inline void computeToTransfer(const Recording& commands)
{
    memoryBarrier(commands, computeAccess, transferAccess);
}

/// Compute or copy → the CPU, after the submission's fence.
inline void anythingToHost(const Recording& commands)
{
    memoryBarrier(commands, anyAccess, hostAccess);
}

} // namespace sward::gpu
