#pragma once

#include "field/cells.h"
#include "field/delta.h"
#include "field/field.h"
#include "render/field/free_ranges.h"
#include "render/field/grass_cover.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// The cover of an edited field: what each 32 m cell adds to the corners of the grid, so that an
/// edit reads only the blades of its cells. The grid stays as it was; grass outside counts at its
/// edge.
class EditedCover {
public:
    /// The grid need not have values. Each blade stands for `bladesPerStored`.
    EditedCover(const field::FieldView& field, const field::LeafAreaGrid& grid,
                double bladesPerStored);

    /// Replaces cells. Returns a range that holds all changed corners, and colours `cover`.
    PlaceRange apply(const field::Delta& delta, shared::Cover& cover);

    std::span<const std::uint32_t> values() const
    {
        return values_;
    } ///< as field::LeafAreaGrid::values

private:
    struct Corner {
        std::uint32_t index = 0;
        glm::vec3 amounts{0.0f}; ///< [m²] of blades, that times their height [m], and their tone
    };
    struct Cell {
        std::vector<Corner> corners;
        glm::dvec3 roots{0.0}; ///< colours times m²
        glm::dvec3 tips{0.0};
        double leaves = 0.0;  ///< [m²]
        double heights = 0.0; ///< [m³] that times the height
    };

    Cell measured(std::span<const shared::Patch> patches,
                  std::span<const shared::PackedBlade> blades, double share);
    void add(const Cell& cell, double sign);

    shared::Cover shape_;
    std::vector<field::Species> species_;
    std::map<field::CellIndex, Cell> cells_;
    float bladesPerStored_;
    float meanHeight_;               ///< [m] 0: the field was bare
    std::vector<glm::vec3> scratch_; ///< one per corner, all 0
    std::vector<glm::dvec3> leaves_; ///< Corner::amounts of all cells
    std::vector<float> ground_;      ///< [m²]
    std::vector<std::uint32_t> values_;
    Cell sum_; ///< of colours
};

} // namespace sward::render
