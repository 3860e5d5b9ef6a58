#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// Memory for one buffer or image, as a host's allocator is asked for it.
struct MemoryRequest {
    VkMemoryRequirements requirements{}; ///< of the buffer or image
    std::uint32_t type = 0;              ///< index of the memory type, one that they allow
    bool isMapped = false;               ///< the CPU reads or writes it; the type is host-coherent
    bool hasAddress = false;             ///< allocated with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT
    const char* name = "";               ///< of what it is for, in words
};

/// What the allocator gives: a part of some memory.
struct MemoryPiece {
    VkDeviceMemory memory = VK_NULL_HANDLE; ///< of the type that was asked for
    VkDeviceSize offset = 0;                ///< [bytes] a multiple of the alignment required
    void* mapped = nullptr;                 ///< its first byte, if it was to be mapped
    void* token = nullptr;                  ///< the allocator's own, to know it again
};

/// A host's allocator of device memory, as two functions. They are called by the thread that calls
/// what throws (never by what records), and by destructors; they throw nothing.
struct HostMemory {
    void* allocator = nullptr; ///< handed to both

    /// Fills in the piece; VK_SUCCESS or why not.
    VkResult (*allocate)(void* allocator, const MemoryRequest& request,
                         MemoryPiece& piece) = nullptr;

    /// Nothing is in the piece any more.
    void (*release)(void* allocator, const MemoryPiece& piece) = nullptr;
};

} // namespace sward::gpu
