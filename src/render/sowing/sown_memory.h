#pragma once

#include "render/sowing/device_sower.h"
#include "render/sowing/sown_tables.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace sward::render {

/// How the memory of a field that sows is used.
struct SownMemory {
    SownTables::Room room;
    std::optional<DeviceSower::Settings> device; ///< if the device grows blades

    /// Divides `bytes` of device memory. `bytesPerBlade`: of a place of the field's tables, but for
    /// its patch. The device grows blades if `onDevice`, or by default if it is no CPU.
    static SownMemory of(std::uint64_t bytes, std::uint64_t bytesPerBlade,
                         std::uint32_t framesInFlight, std::optional<bool> onDevice, bool isCpu)
    {
        SownMemory memory;
        if (onDevice.value_or(!isCpu)) {
            memory.device = DeviceSower::Settings::of(bytes, framesInFlight);
            bytes -= std::min(bytes / 2, memory.device->deviceBytes());
        }
        memory.room =
            SownTables::Room::of(bytes / (bytesPerBlade + SownTables::Room::bytesOfPatches));
        return memory;
    }
};

} // namespace sward::render
