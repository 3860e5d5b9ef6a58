#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace sward::apps {

inline constexpr std::size_t maxPosterBytes = 150'000; ///< so that a page shows it at once
inline constexpr unsigned maxPosterSide = 1280;        ///< [pixels]

/// A picture file (PNG, JPEG, TGA or BMP) as a JPEG of at most maxPosterSide pixels a side and
/// maxPosterBytes. Throws Error{io}; Error{input} if it is no picture.
std::string readPoster(const std::filesystem::path& path);

} // namespace sward::apps
