#pragma once

#include "gpu/context/owned.h"

#include <vulkan/vulkan.h>

#include <utility>

namespace sward::gpu {

/// Owns a Vulkan object that its parent destroys: Unique<VkPipeline, vkDestroyPipeline>.
template <typename Handle, auto destroy, typename Parent = VkDevice>
class Unique {
public:
    Unique() = default;
    Unique(Parent parent, Handle handle)
        : parent_(parent)
        , handle_(handle)
    {
    }
    Unique(Unique&& other) noexcept
        : parent_(other.parent_)
        , handle_(std::exchange(other.handle_, VK_NULL_HANDLE))
    {
    }
    Unique& operator=(Unique&& other) noexcept
    {
        std::swap(parent_, other.parent_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Unique()
    {
        if (handle_ != VK_NULL_HANDLE)
            destroy(parent_, handle_, nullptr);
    }

    Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

private:
    Parent parent_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

/// Owns a Vulkan object without a parent: the instance and the device.
template <typename Handle, auto destroy>
class UniqueRoot {
public:
    UniqueRoot() = default;
    explicit UniqueRoot(Handle handle)
        : handle_(handle)
    {
    }
    UniqueRoot(UniqueRoot&& other) noexcept
        : handle_(std::exchange(other.handle_, VK_NULL_HANDLE))
    {
    }
    UniqueRoot& operator=(UniqueRoot&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~UniqueRoot()
    {
        if (handle_ != VK_NULL_HANDLE)
            destroy(handle_, nullptr);
    }

    Handle get() const { return handle_; }

private:
    Handle handle_ = VK_NULL_HANDLE;
};

using Fence = Owned<VkFence, &DeviceFunctions::DestroyFence>;
using Semaphore = Owned<VkSemaphore, &DeviceFunctions::DestroySemaphore>;
using ImageView = Owned<VkImageView, &DeviceFunctions::DestroyImageView>;
// With the host's own loader there are no functions to link with, and Sward makes no surface.
#ifndef VK_NO_PROTOTYPES
using Surface = Unique<VkSurfaceKHR, vkDestroySurfaceKHR, VkInstance>;
#endif

} // namespace sward::gpu
