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

// An up-vector is packed with an error e; cos e ≥ 1 − e²/2.
constexpr float packedUpCosine =
    1.0f - 0.5f * shared::octahedralMaxError * shared::octahedralMaxError;

// Cosine of the sum of two angles in [0, π] given by their cosines; −1 from π on.
float cosineOfSum(float a, float b)
{
    if (a <= -b)
        return -1.0f;
    const float sines = (1.0f - a * a) * (1.0f - b * b);
    return a * b - std::sqrt(std::max(sines, 0.0f));
}

} // namespace

void SubtreeDescription::addOwn(const std::vector<shared::Blade>& blades,
                                std::span<const std::uint32_t> own)
{
    for (const std::uint32_t index : own) {
        const shared::Blade& blade = blades[index];
        const glm::vec3 reach(reachOf(blade));
        box_.add(blade.root - reach);
        box_.add(blade.root + reach);
        sum_ += glm::dvec3(blade.up);
        parts_.push_back({blade.up, packedUpCosine});
    }
    count_ += own.size();
}

void SubtreeDescription::addChild(const SubtreeDescription& child)
{
    box_.add(child.box_);
    sum_ += child.sum_;
    count_ += child.count_;
    parts_.push_back(child.cone_);
}

void SubtreeDescription::finish(shared::Patch& patch)
{
    // Axis: the mean up-vector; opening: the part that leans away most, and some rounding.
    const double length = std::sqrt(glm::dot(sum_, sum_));
    if (length > 1e-6 * double(count_)) {
        cone_.axis = glm::vec3(sum_ / length);
        float cosine = 1.0f;
        for (const Cone& part : parts_)
            cosine = std::min(
                cosine,
                cosineOfSum(std::clamp(glm::dot(cone_.axis, part.axis), -1.0f, 1.0f), part.cosine));
        cone_.cosine = std::max(cosine - 1e-6f, -1.0f);
    }
    parts_.clear();
    patch.boundsLow = box_.low;
    patch.boundsHigh = box_.high;
    patch.coneAxis = cone_.axis;
    patch.coneCosine = cone_.cosine;
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
