#pragma once

#include "apps/sward_view/picture/png.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace sward::view {

/// Subpixel offset of picture `index` of a mean [pixels], in [−1/2, 1/2)²: the Halton sequence of
/// bases 2 and 3.
glm::vec2 subpixelOffset(std::uint32_t index);

/// The mean of pictures in linear light, whole or in parts.
class PictureMean {
public:
    explicit PictureMean(glm::uvec2 size);

    /// Adds a picture of the part of that size which begins at pixel `first`.
    void add(const Picture& picture, glm::uvec2 first = glm::uvec2(0));

    /// The mean of the `count` > 0 pictures that were added to all of the part.
    Picture mean(std::uint32_t count, glm::uvec2 first, glm::uvec2 size) const;
    Picture mean(std::uint32_t count) const { return mean(count, glm::uvec2(0), size_); }

    glm::uvec2 size() const { return size_; }

private:
    std::size_t placeOf(glm::uvec2 pixel) const;

    glm::uvec2 size_;
    std::vector<float> sums_; ///< linear; four per pixel
};

} // namespace sward::view
