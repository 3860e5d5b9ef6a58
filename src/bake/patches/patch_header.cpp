#include "bake/patches/patch_header.h"

#include "core/bounds.h"

#include <algorithm>

namespace sward::bake {

void describeOwn(shared::Patch& patch, std::span<const GrownBlade> own)
{
    if (own.empty())
        return;
    Aabb roots;
    float heightHigh = 0.0f;
    float widthHigh = 0.0f;
    patch.heightLow = own[0].blade.height;
    patch.widthLow = own[0].blade.width;
    for (const GrownBlade& grown : own) {
        const shared::Blade& blade = grown.blade;
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
