#include "render/preview/ground_clusters.h"

#include "core/bounds.h"
#include "core/math/spread_bits.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sward::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Position on a Z-curve through a cube of side `side` at `low`.
std::uint64_t placeOnCurve(glm::vec3 point, glm::vec3 low, float side)
{
    constexpr float steps = 2097151.0f;
    const glm::vec3 cell = glm::clamp((point - low) / side, 0.0f, 1.0f) * steps;
    return mortonCode(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                      static_cast<std::uint32_t>(cell.z));
}

} // namespace

void sortTriangles(std::span<const shared::GroundVertex> corners, std::span<std::uint32_t> indices)
{
    const std::size_t count = indices.size() / 3;
    const auto corner = [&](std::size_t i) { return corners[indices[i]].position; };
    Aabb all;
    for (std::size_t i = 0; i < indices.size(); ++i)
        all.add(corner(i));
    const glm::vec3 size = all.size();
    const float side = std::max(std::max(size.x, size.y), std::max(size.z, 1e-6f));

    struct Placed {
        std::uint64_t code;
        std::uint32_t triangle;
    };
    std::vector<Placed> order(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 middle =
            (corner(3 * i) + corner(3 * i + 1) + corner(3 * i + 2)) * (1.0f / 3.0f);
        order[i] = {placeOnCurve(middle, all.low, side), static_cast<std::uint32_t>(i)};
    }
    std::sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
        return a.code != b.code ? a.code < b.code : a.triangle < b.triangle;
    });
    std::vector<Triangle> sorted(count);
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(indices.begin() + std::ptrdiff_t(3) * order[i].triangle, 3, sorted[i].begin());
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(sorted[i].begin(), 3, indices.begin() + static_cast<std::ptrdiff_t>(3 * i));
}

std::vector<shared::GroundCluster> clustersOf(std::span<const shared::GroundVertex> corners,
                                              std::span<const std::uint32_t> indices,
                                              std::uint32_t material)
{
    constexpr std::size_t most = std::size_t(3) * shared::clusterTriangles;
    std::vector<shared::GroundCluster> clusters;
    clusters.reserve((indices.size() + most - 1) / most);
    for (std::size_t first = 0; first < indices.size(); first += most) {
        const std::size_t end = std::min(first + most, indices.size());
        Aabb box;
        for (std::size_t i = first; i < end; ++i)
            box.add(corners[indices[i]].position);
        clusters.push_back({.low = box.low,
                            .material = material,
                            .high = box.high,
                            .indexCount = static_cast<std::uint32_t>(end - first)});
    }
    return clusters;
}

} // namespace sward::render
