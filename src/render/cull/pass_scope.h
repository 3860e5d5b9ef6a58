#pragma once

#include "gpu/context/debug.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Labels a pass during its lifetime, and measures it if timestamps are given.
class PassScope {
public:
    PassScope(const gpu::DeviceContext& context, const gpu::Recording& commands,
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
    gpu::Recording commands_;
    gpu::Timestamps* timestamps_;
    std::uint32_t scope_;
};

/// A PassScope outside of a rendering. On a CPU device a barrier follows its first timestamp:
/// lavapipe dispatches at once, but writes timestamps only when it waits for what was recorded
/// before; without the barrier a dispatch would be over before its scope begins.
class DispatchScope : PassScope {
public:
    DispatchScope(const gpu::DeviceContext& context, const gpu::Recording& commands,
                  gpu::Timestamps* timestamps, const char* name)
        : PassScope(context, commands, timestamps, name)
    {
        if (timestamps != nullptr && context.isCpu())
            gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    }
};

} // namespace sward::render
