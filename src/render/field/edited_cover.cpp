#include "render/field/edited_cover.h"

#include "field/measure/cover_corners.h"
#include "field/measure/leaf_heights.h"

#include <algorithm>
#include <utility>

namespace sward::render {
namespace {

/// Blades that are read of an edited cell: about 64 for each corner of the grid on level ground, as
/// the whole field has at its beginning. The upper bound takes some 2 ms.
double bladesToRead(const shared::Cover& shape)
{
    constexpr double cellEdge = 32.0; // [m]
    const double along = cellEdge * double(shape.cellsPerMetre) + 1.0;
    return std::clamp(64.0 * along * along, 2048.0, 16384.0);
}

} // namespace

EditedCover::EditedCover(const field::FieldView& field, const field::LeafAreaGrid& grid,
                         double bladesPerStored)
    : shape_(grid.shape)
    , species_(field.species.begin(), field.species.end())
    , bladesPerStored_(static_cast<float>(bladesPerStored))
    , meanHeight_(grid.meanHeight)
    , scratch_(grid.values.size(), glm::vec3(0.0f))
    , leaves_(grid.values.size(), glm::dvec3(0.0))
    , ground_(field::groundAreasOf(field, grid.shape))
    , values_(grid.values)
{
    const double share =
        std::min(1.0, double(field::maxCoverBlades) / std::max(double(field.blades.size()), 1.0));
    std::vector<shared::Patch> patches;
    for (const field::FieldCell& cell : field::cellsOf(field)) {
        patches.clear();
        for (const std::uint32_t patch : cell.patches)
            patches.push_back(field.patches[patch]);
        Cell& measure = cells_[cell.cell];
        measure = measured(patches, field.blades, share);
        add(measure, 1.0);
    }
}

EditedCover::Cell EditedCover::measured(std::span<const shared::Patch> patches,
                                        std::span<const shared::PackedBlade> blades, double share)
{
    Cell cell;
    for (const shared::Patch& patch : patches)
        field::forSomeBlades(species_, patch, blades, share, [&](const field::CoverBlade& blade) {
            cell.roots += double(blade.area) * glm::dvec3(blade.look->rootColor);
            cell.tips += double(blade.area) * glm::dvec3(blade.look->tipColor);
            cell.leaves += double(blade.area);
            cell.heights += double(blade.area) * double(blade.height);
            field::dealToCorners(
                shape_, blade.root, blade.area, [&](std::size_t corner, float part) {
                    if (part <= 0.0f)
                        return;
                    if (scratch_[corner].x == 0.0f)
                        cell.corners.push_back({static_cast<std::uint32_t>(corner), {}});
                    scratch_[corner] += part * glm::vec3(1.0f, blade.height, blade.tone);
                });
        });
    for (Corner& corner : cell.corners)
        corner.amounts = std::exchange(scratch_[corner.index], glm::vec3(0.0f));
    return cell;
}

void EditedCover::add(const Cell& cell, double sign)
{
    for (const Corner& corner : cell.corners)
        leaves_[corner.index] += sign * glm::dvec3(corner.amounts);
    sum_.roots += sign * cell.roots;
    sum_.tips += sign * cell.tips;
    sum_.leaves += sign * cell.leaves;
    sum_.heights += sign * cell.heights;
}

PlaceRange EditedCover::apply(const field::Delta& delta, shared::Cover& cover)
{
    std::uint32_t low = static_cast<std::uint32_t>(values_.size());
    std::uint32_t end = 0;
    const auto touch = [&](const Cell& cell, double sign) {
        add(cell, sign);
        for (const Corner& corner : cell.corners) {
            low = std::min(low, corner.index);
            end = std::max(end, corner.index + 1);
        }
    };
    for (const field::CellChange& change : delta.cells) {
        Cell& cell = cells_[change.cell];
        touch(cell, -1.0);
        const double blades = std::max(double(change.blades.size()), 1.0);
        cell =
            measured(change.patches, change.blades, std::min(1.0, bladesToRead(shape_) / blades));
        touch(cell, 1.0);
    }
    // What remains of removed blades is rounding.
    constexpr double nothing = 1e-9;
    if (meanHeight_ <= 0.0f && sum_.leaves > nothing) {
        // The first blades of a bare field.
        meanHeight_ = static_cast<float>(sum_.heights / sum_.leaves);
        field::describeHeights(field::leafHeightsOf(meanHeight_), cover);
    }
    for (std::uint32_t corner = low; corner < end; ++corner) {
        const glm::dvec3 amounts = leaves_[corner];
        values_[corner] = amounts.x < nothing
                              ? 0
                              : field::grassOf(bladesPerStored_ * glm::vec3(amounts),
                                               ground_[corner], meanHeight_);
    }
    if (sum_.leaves > nothing)
        field::colorUndergrowth(glm::vec3(sum_.roots / sum_.leaves),
                                glm::vec3(sum_.tips / sum_.leaves), cover);
    return low < end ? PlaceRange{low, end - low} : PlaceRange{};
}

} // namespace sward::render
