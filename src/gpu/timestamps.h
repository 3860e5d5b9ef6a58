#pragma once

#include "gpu/context.h"
#include "gpu/debug.h"
#include "gpu/handle.h"
#include "gpu/statistics.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gpu {

struct TimestampSettings {
    std::uint32_t slots = 2;             ///< frames in flight
    std::uint32_t scopes = 112;          ///< the most of one frame
    std::uint32_t historyFrames = 4'096; ///< older measurements are forgotten
};

/// How long the device takes for named parts of a frame. A part begins when everything before it is
/// done and ends when everything in it is. On a queue without timestamps nothing is measured.
class Timestamps {
public:
    explicit Timestamps(const DeviceContext& context, const TimestampSettings& settings = {});

    /// Takes over what the slot's former frame measured, and makes room for the new one. The device
    /// must be done with that frame, as it is after FrameRing::begin(), and a frame that is begun
    /// is submitted. Recorded outside of any rendering.
    void beginFrame(VkCommandBuffer commands, std::uint32_t slot);

    /// Begins a part; returns what end() takes. Parts may contain each other; what several parts of
    /// one name take is added up. Beyond the settings'
    /// number of scopes a part is not measured.
    std::uint32_t begin(VkCommandBuffer commands, std::string_view name);
    void end(VkCommandBuffer commands, std::uint32_t scope);

    /// Takes over what all slots have measured. The device must be done with them.
    void collect();

    /// Names in the order in which they first appeared.
    std::vector<std::string> names() const;

    /// Durations [ms], the latest last; empty for an unknown name.
    std::vector<double> history(std::string_view name) const;
    Statistics statistics(std::string_view name) const { return statisticsOf(history(name)); }

    /// Forgets all durations, after warming up for instance; what is in flight still counts.
    void clearHistory() { series_.clear(); }

private:
    struct Series {
        std::string name;
        std::vector<double> milliseconds; ///< a ring once it is full
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

/// Measures and labels what is recorded while it lives.
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
