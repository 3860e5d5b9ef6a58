#pragma once

#include <span>
#include <string_view>

namespace sward {

/// A file compiled into the program by sward_embed() (cmake/embed.cmake).
struct EmbeddedFile {
    std::string_view name;
    std::span<const unsigned char> bytes;

    std::string_view text() const
    {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
};

} // namespace sward
