#pragma once

#include "gpu/context/context.h"

#include <vulkan/vulkan.h>

#include <utility>

namespace sward::gpu {

/// Owns an object of a device; the context outlives it: Owned<VkPipeline,
/// &DeviceFunctions::DestroyPipeline>.
template <typename Handle, auto destroy>
class Owned {
public:
    Owned() = default;
    Owned(const DeviceContext& context, Handle handle)
        : context_(&context)
        , handle_(handle)
    {
    }
    Owned(Owned&& other) noexcept
        : context_(other.context_)
        , handle_(std::exchange(other.handle_, VK_NULL_HANDLE))
    {
    }
    Owned& operator=(Owned&& other) noexcept
    {
        std::swap(context_, other.context_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE)
            (context_->vk.*destroy)(context_->device, handle_, context_->allocation);
    }

    Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

private:
    const DeviceContext* context_ = nullptr;
    Handle handle_ = VK_NULL_HANDLE;
};

} // namespace sward::gpu
