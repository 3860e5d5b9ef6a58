#include "support/fields/plain_tree.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sward::test {
namespace {

constexpr float cellSize = 32.0f;     ///< [m] of the widest node that owns blades
constexpr float bladeHeight = 1.0f;   ///< [m]
constexpr std::uint32_t owned = 256u; ///< blades of a node, if there are so many

} // namespace

field::Field plainTree(const PlainTreeSettings& settings)
{
    field::Field field;
    field.species.resize(1);
    std::vector<shared::Patch>& patches = field.patches;
    const float half = 0.5f * settings.extent;
    shared::Patch root = {};
    root.boundsLow = {-half, 0.0f, -half};
    root.boundsHigh = {half, bladeHeight, half};
    root.parent = shared::noPatch;
    patches.push_back(root);
    std::size_t blades = 0;
    const float inCell = settings.density * cellSize * cellSize;

    // Level by level: all nodes of a level have the same size and as many blades below them.
    float size = settings.extent;
    float below = settings.density * size * size;
    float rank = 0.0f;
    for (std::size_t first = 0; first < patches.size();) {
        const std::size_t end = patches.size();
        const bool owns = size <= cellSize;
        const float own = owns ? std::min(std::round(below), float(owned)) : 0.0f;
        const float left = below - own;
        // The ranks of a level are those of all its nodes in a cell.
        const float nodes = owns ? (cellSize / size) * (cellSize / size) : 0.0f;
        const float rankHigh = left < 1.0f ? 1.0f : std::min(rank + own * nodes / inCell, 1.0f);
        for (std::size_t p = first; p < end; ++p) {
            patches[p].firstBlade = static_cast<std::uint32_t>(blades);
            patches[p].bladeCount = static_cast<std::uint32_t>(own);
            patches[p].widthLow = settings.width;
            patches[p].rankLow = rank;
            patches[p].rankHigh = rankHigh;
            patches[p].firstChild = shared::noPatch;
            blades += patches[p].bladeCount;
            if (left < 4.0f)
                continue;
            patches[p].firstChild = static_cast<std::uint32_t>(patches.size());
            patches[p].childCount = 4;
            for (std::uint32_t child = 0; child < 4; ++child) {
                shared::Patch cell = {};
                const glm::vec3 low = patches[p].boundsLow;
                const float x = low.x + (child & 1u ? 0.5f * size : 0.0f);
                const float z = low.z + (child & 2u ? 0.5f * size : 0.0f);
                cell.boundsLow = {x, 0.0f, z};
                cell.boundsHigh = {x + 0.5f * size, bladeHeight, z + 0.5f * size};
                cell.parent = static_cast<std::uint32_t>(p);
                cell.level = patches[p].level + 1;
                patches.push_back(cell);
            }
        }
        first = end;
        size *= 0.5f;
        below = 0.25f * left;
        rank = owns ? rankHigh : 0.0f;
    }
    field.blades.resize(blades);
    return field;
}

} // namespace sward::test
