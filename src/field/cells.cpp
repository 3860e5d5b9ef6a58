#include "field/cells.h"

#include "core/error.h"
#include "shaders/shared/blade.h"

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

constexpr double worldCell = 32.0; // [m]

// The cell of a patch: that of the mean of its roots, which packing cannot move out of the cell.
CellIndex cellOfPatch(const FieldView& field, const shared::Patch& patch)
{
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
        sum += glm::dvec3(shared::unpackBlade(field.blades[patch.firstBlade + i], patch).root);
    const glm::dvec3 mean = field.origin + sum / static_cast<double>(patch.bladeCount);
    CellIndex cell;
    for (int axis = 0; axis < 3; ++axis)
        cell[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(mean[axis] / worldCell));
    return cell;
}

} // namespace

std::vector<FieldCell> cellsOf(const FieldView& field)
{
    // Wider cells own no blades, and each 32 m cell does.
    std::vector<FieldCell> cells;
    std::vector<std::uint32_t> waiting;
    if (!field.patches.empty())
        waiting.push_back(0);
    while (!waiting.empty()) {
        const shared::Patch& patch = field.patches[waiting.back()];
        FieldCell found{.cell = {}, .patches = {waiting.back()}};
        waiting.pop_back();
        if (patch.bladeCount == 0) {
            for (std::uint32_t i = 0; i < patch.childCount; ++i)
                waiting.push_back(patch.firstChild + i);
            continue;
        }
        found.cell = cellOfPatch(field, patch);
        for (std::size_t p = 0; p < found.patches.size(); ++p) {
            const shared::Patch& node = field.patches[found.patches[p]];
            for (std::uint32_t i = 0; i < node.childCount; ++i)
                found.patches.push_back(node.firstChild + i);
        }
        cells.push_back(std::move(found));
    }
    std::ranges::sort(cells, {}, &FieldCell::cell);
    const auto same = std::ranges::adjacent_find(cells, {}, &FieldCell::cell);
    if (same != cells.end())
        fail(ErrorKind::unsupported,
             "the field cannot be edited: patches {} and {} both lie in the 32 m cell ({}, {}, {})",
             same->patches[0], (same + 1)->patches[0], same->cell[0], same->cell[1], same->cell[2]);
    return cells;
}

CellContent contentOf(const FieldView& field, const FieldCell& cell)
{
    CellContent content;
    content.patches.reserve(cell.patches.size());
    const std::uint32_t topLevel = field.patches[cell.patches[0]].level;
    std::uint32_t blades = 0;
    std::uint32_t children = 1;
    for (const std::uint32_t index : cell.patches) {
        shared::Patch& patch = content.patches.emplace_back(field.patches[index]);
        patch.level -= topLevel;
        patch.firstBlade = blades;
        blades += patch.bladeCount;
        patch.parent = shared::noPatch; // its parent comes before it and is set below
        patch.firstChild = patch.childCount == 0 ? shared::noPatch : children;
        children += patch.childCount;
    }
    content.blades.resize(blades);
    content.keys.resize(field.keys.empty() ? 0 : blades);
    for (std::uint32_t p = 0; p < content.patches.size(); ++p) {
        const shared::Patch& patch = content.patches[p];
        for (std::uint32_t i = 0; i < patch.childCount; ++i)
            content.patches[patch.firstChild + i].parent = p;
        const auto from = static_cast<std::ptrdiff_t>(field.patches[cell.patches[p]].firstBlade);
        const auto to = static_cast<std::ptrdiff_t>(patch.firstBlade);
        std::copy_n(field.blades.begin() + from, patch.bladeCount, content.blades.begin() + to);
        if (!field.keys.empty())
            std::copy_n(field.keys.begin() + from, patch.bladeCount, content.keys.begin() + to);
    }
    return content;
}

} // namespace sward::field
