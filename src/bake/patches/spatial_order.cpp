#include "bake/patches/spatial_order.h"

#include "core/bounds.h"
#include "core/math/spread_bits.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace sward::bake {
namespace {

// Cells of the curve on each axis: 21 bits, so that three axes fit into 63.
constexpr float cellsPerAxis = 2097151.0f;

struct Entry {
    std::uint64_t code;
    std::uint32_t index;
};

} // namespace

void sortSpatially(const terrain::GroundMesh& ground, Roots& roots)
{
    Aabb box;
    for (const RootSample& root : roots)
        box.add(root.position);
    const glm::vec3 size = box.size();
    const float longest = std::max({size.x, size.y, size.z, 1e-30f});

    UninitializedVector<Entry> entries(roots.size());
    tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
        const glm::vec3 cell = (roots[i].position - box.low) / longest * cellsPerAxis;
        entries[i] = {mortonCode(static_cast<std::uint32_t>(cell.x),
                                 static_cast<std::uint32_t>(cell.y),
                                 static_cast<std::uint32_t>(cell.z)),
                      static_cast<std::uint32_t>(i)};
    });
    const auto keyAt = [&](const Entry& entry) {
        return keyBits(keyOf(ground, roots[entry.index]));
    };
    tbb::parallel_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
        return a.code != b.code ? a.code < b.code : keyAt(a) < keyAt(b);
    });
    Roots sorted(roots.size());
    tbb::parallel_for(std::size_t(0), roots.size(),
                      [&](std::size_t i) { sorted[i] = roots[entries[i].index]; });
    roots = std::move(sorted);
}

} // namespace sward::bake
