#pragma once

#include "gpu/context/context.h"
#include "gpu/recording/statistics.h"

#include <cstdint>
#include <string>

namespace sward::view {

/// Copy bandwidth within device memory: a bound for any pass that reads and writes each blade.
/// Drivers' copies may be much slower (an H200's by a factor of five), so a compute shader is
/// measured too.
struct CopyBandwidth {
    std::string device;
    std::string driver;
    std::uint64_t bytes = 0;     ///< of one copy
    gpu::Statistics byCommand{}; ///< [ms] of one copy
    gpu::Statistics byShader{};  ///< the same

    bool isShaderFaster() const { return byShader.median < byCommand.median; }
    const gpu::Statistics& times() const { return isShaderFaster() ? byShader : byCommand; }

    /// Bytes read and written per second by the faster method, from the median [10⁹ bytes/s]; 0 on
    /// a queue without timestamps.
    double gigabytesPerSecond() const;
};

/// Copies an eighth of the device's memory, at most 1 GiB and on a CPU 64 MiB, `copies` times by
/// each method. Throws as gpu::Buffer and gpu::FrameRing do, and Error{runtime} if the copy differs
/// from the source.
CopyBandwidth measureCopies(const gpu::DeviceContext& context, std::uint32_t copies);

/// Formats it as a JSON object in one line.
std::string copyText(const CopyBandwidth& copies);

} // namespace sward::view
