#include "field/measure/subtree_bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

// A blade's curve stays within its length of the root (poseBlade() keeps it to 0.1 %). Half the
// width extends to the sides. The rest covers packing. A ribbon begins on that curve.
float reachOf(const GrownBlade& grown)
{
    return 1.02f * (grown.blade.height + grown.ribbon) + 0.55f * grown.blade.width;
}

// Up-vectors are packed with an angular error e; cos e ≥ 1 − e²/2.
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

void SubtreeDescription::addOwn(std::span<const GrownBlade> own)
{
    for (const GrownBlade& grown : own) {
        const shared::Blade& blade = grown.blade;
        const glm::vec3 reach(reachOf(grown));
        box_.add(blade.root - reach);
        box_.add(blade.root + reach);
        sum_ += glm::dvec3(blade.up);
        parts_.push_back({blade.up, packedUpCosine});
    }
    count_ += own.size();
}

void SubtreeDescription::addChild(const Summary& child)
{
    box_.add(child.boundsLow);
    box_.add(child.boundsHigh);
    sum_ += glm::dvec3(child.coneAxis) * double(child.count);
    count_ += child.count;
    parts_.push_back({child.coneAxis, child.coneCosine});
}

SubtreeDescription::Summary SubtreeDescription::finish(shared::Patch& patch)
{
    // Axis: about the mean up-vector. Opening: the largest deviation from it, plus rounding.
    Cone cone{glm::vec3(0.0f, 1.0f, 0.0f), -1.0f};
    const double length = std::sqrt(glm::dot(sum_, sum_));
    if (length > 1e-6 * double(count_)) {
        cone.axis = glm::vec3(sum_ / length);
        float cosine = 1.0f;
        for (const Cone& part : parts_)
            cosine = std::min(
                cosine,
                cosineOfSum(std::clamp(glm::dot(cone.axis, part.axis), -1.0f, 1.0f), part.cosine));
        cone.cosine = std::max(cosine - 1e-6f, -1.0f);
    }
    patch.boundsLow = box_.low;
    patch.boundsHigh = box_.high;
    patch.coneAxis = cone.axis;
    patch.coneCosine = cone.cosine;
    return {box_.low, box_.high, count_, cone.axis, cone.cosine};
}

} // namespace sward::field
