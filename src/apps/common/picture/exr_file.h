#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::apps {

/// A channel of an OpenEXR picture: a number for each pixel, rows from the top.
struct ExrChannel {
    /// How a channel is held, in memory and in the file.
    enum class Type {
        half,  ///< 16-bit floating point (std::uint16_t in memory)
        real,  ///< float
        whole, ///< std::uint32_t
    };

    std::string name;            ///< unique; "R", or "layer.R"
    Type type = Type::real;      ///< of each number
    const void* first = nullptr; ///< number of the upper left pixel
    std::size_t step = 4;        ///< [bytes] from one pixel to the next
};

/// A picture of a file with several: a part.
struct ExrPart {
    std::string name;                 ///< unique
    std::vector<ExrChannel> channels; ///< of this part
};

/// How parts are compressed, without loss.
enum class ExrCompression {
    none, ///< fast to write
    zip,  ///< small
};

/// Writes parts of `size` pixels each, as writeExr() does.
void writeExrParts(glm::uvec2 size, std::span<const ExrPart> parts, ExrCompression compression,
                   const std::filesystem::path& path, bool overwrite);

/// Writes channels of `size` pixels as scan lines with ZIP compression, whole or not at all. The
/// bytes depend on nothing else. Throws Error{io}; Error{runtime} if the picture cannot be encoded.
void writeExr(glm::uvec2 size, std::span<const ExrChannel> channels,
              const std::filesystem::path& path, bool overwrite);

} // namespace sward::apps
