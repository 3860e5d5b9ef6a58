#pragma once

#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::render {

/// A buffer that another one replaces, which has room for more.
struct Outgrown {
    gpu::Buffer former;            ///< to be destroyed when no frame in flight uses it
    VkBuffer now = VK_NULL_HANDLE; ///< gets the former bytes; null: they are not wanted
};

/// Replaced buffers, in the order of their replacements.
using OutgrownBuffers = std::vector<Outgrown>;

/// The replaced buffers of running frames: the next frame copies their bytes, and they live until
/// that frame has completed.
class ReplacedBuffers {
public:
    explicit ReplacedBuffers(std::uint32_t framesInFlight)
        : slots_(framesInFlight)
    {
    }

    /// Those that no frame has copied yet. What replaces them must live until one has.
    OutgrownBuffers& waiting() { return waiting_; }

    /// Records the copies, with barriers from and to everything if there are any. The former
    /// commands of `slot` must have completed.
    void record(const gpu::Recording& commands, std::uint32_t slot);

private:
    OutgrownBuffers waiting_;
    std::vector<OutgrownBuffers> slots_;
};

} // namespace sward::render
