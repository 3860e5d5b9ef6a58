#pragma once

#include "gpu/context/context.h"
#include "gpu/context/debug.h"
#include "gpu/context/handle.h"
#include "gpu/recording/statistics.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gpu {

struct TimestampSettings {
    std::uint32_t slots = 2;             ///< frames in flight
    std::uint32_t scopes = 112;          ///< maximum per frame
    std::uint32_t historyFrames = 4'096; ///< older measurements are dropped
};

/// Device durations of named scopes of a frame. A scope begins when all earlier commands are done
/// and ends when its own are. On a queue without timestamps nothing is measured.
class Timestamps {
public:
    explicit Timestamps(const DeviceContext& context, const TimestampSettings& settings = {});

    /// Collects the measurements of the slot's former frame and prepares the new one. The former
    /// frame must have completed, as after FrameRing::begin(), and every begun frame must be
    /// submitted. To be recorded outside of a rendering.
    void beginFrame(VkCommandBuffer commands, std::uint32_t slot);

    /// Begins a scope; returns the argument of end(). Scopes may nest; durations of scopes with the
    /// same name are added. Scopes beyond the settings' limit are not measured.
    std::uint32_t begin(VkCommandBuffer commands, std::string_view name);
    void end(VkCommandBuffer commands, std::uint32_t scope);

    /// Collects the measurements of all slots, whose frames must have completed.
    void collect();

    /// Names in the order in which they first appeared.
    std::vector<std::string> names() const;

    /// Durations [ms], the latest last; empty for an unknown name.
    std::vector<double> history(std::string_view name) const;
    Statistics statistics(std::string_view name) const { return statisticsOf(history(name)); }

    /// Drops all durations, for example after warm-up; frames in flight still count.
    void clearHistory() { series_.clear(); }

private:
    struct Series {
        std::string name;
        std::vector<double> milliseconds; ///< a ring once full
        std::size_t next = 0;
    };

    void collectSlot(std::uint32_t slot);
    void append(const std::string& name, double milliseconds);
    std::uint32_t firstQuery(std::uint32_t slot) const { return slot * settings_.scopes * 2; }

    const DeviceContext& context_;
    TimestampSettings settings_;
    Owned<VkQueryPool, &DeviceFunctions::DestroyQueryPool> queries_;
    std::vector<std::vector<std::string>> pending_; ///< by slot: names of the scopes in flight
    std::uint32_t slot_ = 0;
    std::vector<Series> series_;
};

/// Measures and labels the commands recorded during its lifetime.
class TimedScope {
public:
    TimedScope(Timestamps& timestamps, const DeviceContext& context, VkCommandBuffer commands,
               const char* name)
        : label_(context, commands, name)
        , timestamps_(timestamps)
        , commands_(commands)
        , scope_(timestamps.begin(commands, name))
    {
    }
    TimedScope(const TimedScope&) = delete;
    TimedScope& operator=(const TimedScope&) = delete;
    ~TimedScope() { timestamps_.end(commands_, scope_); }

private:
    LabelScope label_;
    Timestamps& timestamps_;
    VkCommandBuffer commands_;
    std::uint32_t scope_;
};

} // namespace sward::gpu
