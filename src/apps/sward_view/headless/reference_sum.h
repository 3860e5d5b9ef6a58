#pragma once

#include "apps/sward_view/png.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace sward::view {

constexpr std::uint32_t referencePictures = 256;

/// Segments of a blade in a reference picture unless set: a fixed value, because tessellation is
/// level of detail too.
constexpr int referenceSegments = 16;

/// Subpixel offset of picture `index` of a reference [pixels], in [−1/2, 1/2)²: the Halton sequence
/// of bases 2 and 3.
glm::vec2 referenceJitter(std::uint32_t index);

/// The mean of pictures in linear light.
class ReferenceSum {
public:
    explicit ReferenceSum(glm::uvec2 size);

    /// Adds a picture of the same size.
    void add(const Picture& picture);

    Picture mean() const;

private:
    glm::uvec2 size_;
    std::vector<float> sums_; ///< linear; four per pixel
    std::uint32_t count_ = 0;
};

} // namespace sward::view
