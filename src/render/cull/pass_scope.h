#pragma once

#include "gpu/debug.h"
#include "gpu/timestamps.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Labels a pass during its lifetime, and measures it if timestamps are given.
class PassScope {
public:
    PassScope(const gpu::DeviceContext& context, VkCommandBuffer commands,
              gpu::Timestamps* timestamps, const char* name)
        : label_(context, commands, name)
        , commands_(commands)
        , timestamps_(timestamps)
        , scope_(timestamps == nullptr ? 0 : timestamps->begin(commands, name))
    {
    }
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;
    ~PassScope()
    {
        if (timestamps_ != nullptr)
            timestamps_->end(commands_, scope_);
    }

private:
    gpu::LabelScope label_;
    VkCommandBuffer commands_;
    gpu::Timestamps* timestamps_;
    std::uint32_t scope_;
};

} // namespace sward::render
