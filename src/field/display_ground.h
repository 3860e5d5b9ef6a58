#pragma once

#include "shaders/shared/ground.h"

#include <cstdint>
#include <vector>

namespace sward::field {

/// A texture of the ground.
struct Image {
    std::uint32_t width = 0;        ///< [pixels]
    std::uint32_t height = 0;       ///< [pixels]
    std::vector<std::uint8_t> rgba; ///< 4·width·height, sRGB, rows from the top
};

/// Triangles of one material at one level of detail (0 is the finest).
struct GroundRange {
    std::uint32_t level = 0;      ///< of detail
    std::uint32_t material = 0;   ///< index into DisplayGround::materials
    std::uint32_t firstIndex = 0; ///< of DisplayGround::indices
    std::uint32_t indexCount = 0; ///< three per triangle
};

/// The ground as it is drawn. No blades grow from it.
struct DisplayGround {
    std::vector<shared::GroundVertex> vertices;    ///< relative to the origin
    std::vector<std::uint32_t> indices;            ///< three per triangle
    std::vector<GroundRange> ranges;               ///< by level and material
    std::vector<shared::GroundMaterial> materials; ///< of the ranges
    std::vector<Image> images;                     ///< of the materials
};

} // namespace sward::field
