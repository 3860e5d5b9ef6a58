#pragma once

#include <cstdint>
#include <string>

namespace sward {

/// The number by which the system knows this process; no other that runs has it.
std::uint64_t processId() noexcept;

/// A process, told from others that have had its number: by its start time and the system's boot.
struct ProcessName {
    long pid = 0;
    std::string start; ///< of Linux clock ticks since the boot; of Windows 100 ns since 1601
    std::string boot;  ///< the kernel's identifier of this boot; Windows has none

    /// This process.
    static ProcessName own();

    /// Whether that process runs, on this machine.
    bool isAlive() const;

    bool operator==(const ProcessName&) const = default;
};

} // namespace sward
