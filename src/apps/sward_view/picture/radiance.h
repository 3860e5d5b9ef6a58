#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sward::view {

/// Linear radiance: 4·width·height 16-bit floating-point numbers R G B A, rows from the top.
struct Radiance {
    glm::uvec2 size{0};
    std::vector<std::uint16_t> rgba;
};

/// The mean of pictures in linear radiance.
class RadianceMean {
public:
    explicit RadianceMean(glm::uvec2 size);

    void add(const Radiance& picture); ///< of that size
    Radiance mean() const;             ///< of the pictures added, one at least

private:
    glm::uvec2 size_;
    std::vector<float> sums_; ///< four per pixel
    std::uint32_t count_ = 0;
};

/// Writes the channels R G B as 16-bit OpenEXR, whole or not at all. Throws Error{io};
/// Error{runtime} if the picture cannot be encoded.
void writeExr(const Radiance& picture, const std::filesystem::path& path, bool overwrite);

} // namespace sward::view
