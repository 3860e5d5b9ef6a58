#include "render/field/patch_sizes.h"

#include "core/expect.h"

#include <algorithm>

namespace sward::render {

PatchSizes::PatchSizes(std::span<const shared::Patch> patches)
{
    for (const shared::Patch& patch : patches) {
        expect(patch.bladeCount < patches_.size(), "no patch has more blades than it can");
        ++patches_[patch.bladeCount];
    }
}

std::uint64_t PatchSizes::maxBladesOf(std::uint64_t patches) const
{
    std::uint64_t blades = 0;
    for (std::size_t size = patches_.size() - 1; size > 0 && patches > 0; --size) {
        const std::uint64_t taken = std::min<std::uint64_t>(patches, patches_[size]);
        blades += taken * size;
        patches -= taken;
    }
    return blades;
}

std::uint32_t PatchSizes::patchesWithin(std::uint64_t blades) const
{
    std::uint64_t patches = 0;
    for (std::size_t size = patches_.size() - 1; size > 0; --size) {
        const std::uint64_t fit = blades / size;
        patches += std::min<std::uint64_t>(fit, patches_[size]);
        if (fit < patches_[size])
            break;
        blades -= patches_[size] * size;
    }
    return static_cast<std::uint32_t>(patches);
}

} // namespace sward::render
