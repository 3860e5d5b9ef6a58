#pragma once

#include "gpu/context.h"
#include "gpu/statistics.h"

#include <cstdint>
#include <string>

namespace sward::view {

/// How fast a device copies within its own memory: a bound for whatever reads and writes each
/// blade.
struct CopyBandwidth {
    std::string device;
    std::string driver;
    std::uint64_t bytes = 0; ///< of one copy
    gpu::Statistics times;   ///< [ms] of one copy

    /// Read and written, by the median [10⁹ bytes/s]; 0 on a queue without timestamps.
    double gigabytesPerSecond() const;
};

/// Copies an eighth of the device's memory, at most 1 GiB and on a CPU 64 MiB, `copies` times.
/// Throws what gpu::Buffer and gpu::FrameRing throw.
CopyBandwidth measureCopies(const gpu::DeviceContext& context, std::uint32_t copies);

/// As a JSON object in one line.
std::string copyText(const CopyBandwidth& copies);

} // namespace sward::view
