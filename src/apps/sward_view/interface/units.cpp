#include "apps/sward_view/interface/units.h"

#include <fmt/core.h>

namespace sward::view {

std::string countText(std::uint64_t count)
{
    std::string text = std::to_string(count);
    for (std::size_t place = text.size(); place > 3;) {
        place -= 3;
        text.insert(place, 1, ' ');
    }
    return text;
}

std::string bytesText(std::uint64_t bytes)
{
    const auto size = static_cast<double>(bytes);
    if (size >= 1e9)
        return fmt::format("{:.2f} GB", size / 1e9);
    if (size >= 1e6)
        return fmt::format("{:.1f} MB", size / 1e6);
    return size >= 1e3 ? fmt::format("{:.1f} kB", size / 1e3) : fmt::format("{} bytes", bytes);
}

} // namespace sward::view
