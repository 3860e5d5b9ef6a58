#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// A request to a host's allocator: memory for one buffer or image.
struct MemoryRequest {
    VkMemoryRequirements requirements{}; ///< of the buffer or image
    std::uint32_t type = 0;              ///< index of an allowed memory type
    bool isMapped = false;               ///< the CPU reads or writes it; the type is host-coherent
    bool hasAddress = false;             ///< allocated with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT
    const char* name = "";               ///< describes its purpose
};

/// The allocator's result: a range of a memory object.
struct MemoryPiece {
    VkDeviceMemory memory = VK_NULL_HANDLE; ///< of the requested type
    VkDeviceSize offset = 0;                ///< [bytes] a multiple of the alignment required
    void* mapped = nullptr;                 ///< its first byte, if mapping was requested
    void* token = nullptr;                  ///< the allocator's own identifier
};

/// A host's allocator of device memory, as two functions. They are called on the thread that calls
/// a throwing function or a destructor, never while recording; they must not throw.
struct HostMemory {
    void* allocator = nullptr; ///< passed to both functions

    /// Fills in the piece. Returns VK_SUCCESS or an error.
    VkResult (*allocate)(void* allocator, const MemoryRequest& request,
                         MemoryPiece& piece) = nullptr;

    /// Frees the piece, which is no longer in use.
    void (*release)(void* allocator, const MemoryPiece& piece) = nullptr;
};

} // namespace sward::gpu
