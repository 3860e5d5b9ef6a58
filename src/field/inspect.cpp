#include "field/inspect.h"

#include <algorithm>

namespace sward::field {

Summary summarise(const FieldView& field)
{
    Summary summary;
    summary.blades = field.blades.size();
    summary.patches = field.patches.size();
    summary.bounds = field.bounds();
    summary.perSpecies.resize(field.species.size());
    for (const GroundRange& range : field.ground->ranges)
        if (range.level == 0)
            summary.groundTriangles += range.indexCount / 3;

    std::uint64_t inLeaves = 0;
    double heights = 0.0;
    double widths = 0.0;
    summary.heightLow = field.blades.empty() ? 0.0 : 1e300;
    for (const shared::Patch& patch : field.patches) {
        summary.levels = std::max(summary.levels, static_cast<int>(patch.level) + 1);
        if (patch.childCount == 0) {
            ++summary.leaves;
            inLeaves += patch.bladeCount;
        }
        for (const shared::PackedBlade& bits :
             field.blades.subspan(patch.firstBlade, patch.bladeCount)) {
            const shared::Blade blade = shared::unpackBlade(bits, patch);
            if (shared::ribbonNumber(field.species[blade.species].look, blade) > 0) {
                ++summary.ribbons;
                continue;
            }
            heights += double(blade.height);
            widths += double(blade.width);
            summary.heightLow = std::min(summary.heightLow, double(blade.height));
            summary.heightHigh = std::max(summary.heightHigh, double(blade.height));
            ++summary.perSpecies[blade.species];
        }
    }
    if (summary.leaves > 0)
        summary.bladesPerLeaf = double(inLeaves) / double(summary.leaves);
    summary.blades -= summary.ribbons;
    if (summary.blades > 0) {
        summary.heightMean = heights / double(summary.blades);
        summary.widthMean = widths / double(summary.blades);
    }
    return summary;
}

} // namespace sward::field
