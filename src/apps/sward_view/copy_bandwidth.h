#pragma once

#include "gpu/context.h"
#include "gpu/statistics.h"

#include <cstdint>
#include <string>

namespace sward::view {

/// How fast a device copies within its own memory: a bound for whatever reads and writes each
/// blade. Drivers' copies may be far from it (an H200's by a factor of five), so that a compute
/// shader copies, too.
struct CopyBandwidth {
    std::string device;
    std::string driver;
    std::uint64_t bytes = 0;     ///< of one copy
    gpu::Statistics byCommand{}; ///< [ms] of one copy
    gpu::Statistics byShader{};  ///< the same

    bool isShaderFaster() const { return byShader.median < byCommand.median; }
    const gpu::Statistics& times() const { return isShaderFaster() ? byShader : byCommand; }

    /// Read and written the faster way, by the median [10⁹ bytes/s]; 0 on a queue without
    /// timestamps.
    double gigabytesPerSecond() const;
};

/// Copies an eighth of the device's memory, at most 1 GiB and on a CPU 64 MiB, `copies` times each
/// way. Throws what gpu::Buffer and gpu::FrameRing throw, and Error{runtime} if what was copied is
/// not the same.
CopyBandwidth measureCopies(const gpu::DeviceContext& context, std::uint32_t copies);

/// As a JSON object in one line.
std::string copyText(const CopyBandwidth& copies);

} // namespace sward::view
