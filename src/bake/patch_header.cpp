#include "bake/patch_header.h"

#include "core/bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

// A blade's curve stays within its length of the root, which poseBlade() keeps to 0.1 %; half the
// width stands out to the sides. The rest covers packing.
float reachOf(const shared::Blade& blade)
{
    return 1.02f * blade.height + 0.55f * blade.width;
}

} // namespace

void describeSubtree(shared::Patch& patch, const std::vector<shared::Blade>& blades,
                     std::span<const std::uint32_t> subtree)
{
    Aabb box;
    glm::dvec3 sum(0.0);
    for (const std::uint32_t index : subtree) {
        const shared::Blade& blade = blades[index];
        const glm::vec3 reach(reachOf(blade));
        box.add(blade.root - reach);
        box.add(blade.root + reach);
        sum += glm::dvec3(blade.up);
    }
    patch.boundsLow = box.low;
    patch.boundsHigh = box.high;

    // Axis: the mean up-vector; opening: the one that leans away most.
    const double length = std::sqrt(glm::dot(sum, sum));
    const bool hasAxis = length > 1e-6 * double(subtree.size());
    patch.coneAxis = hasAxis ? glm::vec3(sum / length) : glm::vec3(0.0f, 1.0f, 0.0f);
    float cosine = 1.0f;
    for (const std::uint32_t index : subtree)
        cosine = std::min(cosine, glm::dot(patch.coneAxis, blades[index].up));
    // Room for the packed up-vectors' error: cos(a + e) ≥ cos a − e.
    patch.coneCosine = hasAxis ? std::max(cosine - shared::octahedralMaxError, -1.0f) : -1.0f;
}

void describeOwn(shared::Patch& patch, const std::vector<shared::Blade>& blades,
                 std::span<const std::uint32_t> own)
{
    if (own.empty())
        return;
    Aabb roots;
    float heightHigh = 0.0f;
    float widthHigh = 0.0f;
    patch.heightLow = blades[own[0]].height;
    patch.widthLow = blades[own[0]].width;
    for (const std::uint32_t index : own) {
        const shared::Blade& blade = blades[index];
        roots.add(blade.root);
        patch.heightLow = std::min(patch.heightLow, blade.height);
        patch.widthLow = std::min(patch.widthLow, blade.width);
        heightHigh = std::max(heightHigh, blade.height);
        widthHigh = std::max(widthHigh, blade.width);
    }
    const glm::vec3 size = roots.size();
    patch.rootLow = roots.low;
    patch.rootStep = std::max({size.x, size.y, size.z}) / 65535.0f;
    patch.heightStep = (heightHigh - patch.heightLow) / 255.0f;
    patch.widthStep = (widthHigh - patch.widthLow) / 63.0f;
}

} // namespace sward::bake
