#pragma once

#include <cstdint>
#include <string>

namespace sward::view {

std::string countText(std::uint64_t count); ///< "729 972"
std::string bytesText(std::uint64_t bytes); ///< "18.5 MB"

} // namespace sward::view
