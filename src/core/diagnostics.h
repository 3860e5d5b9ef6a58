#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sward {

/// Warnings gathered while something imperfect but usable is imported or baked.
/// The library collects them; the program prints them and writes them into its report.
class Diagnostics {
public:
    /// Bounds memory: a damaged file may cause as many warnings as it has bytes.
    static constexpr std::size_t warningLimit = 1000;

    /// Adds a warning. Repeated texts are dropped. After the limit, one last warning says that more
    /// were dropped.
    template <typename... Args>
    void warn(fmt::format_string<Args...> format, Args&&... args)
    {
        add(fmt::format(format, std::forward<Args>(args)...));
    }

    /// In the order of the calls of warn().
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    void add(std::string text);

    std::vector<std::string> warnings_;
};

} // namespace sward
