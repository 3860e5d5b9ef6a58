#pragma once

#include <cstdint>

namespace sward {

/// The number by which the system knows this process; no other that runs has it.
std::uint64_t processId() noexcept;

} // namespace sward
