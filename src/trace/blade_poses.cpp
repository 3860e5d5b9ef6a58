#include "trace/blade_poses.h"

#include "field/measure/resting_blade.h"
#include "field/organs.h"

#include <tbb/parallel_for.h>

namespace sward::trace {

std::vector<BladePose> restingPoses(const field::FieldView& field)
{
    const shared::Environment calm = field::calmOf(field);
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    const shared::OrganTable table = field::viewOf(organs);
    std::vector<BladePose> poses(field.blades.size());
    tbb::parallel_for(std::size_t(0), field.patches.size(), [&](std::size_t patch) {
        const shared::Patch& cell = field.patches[patch];
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = std::size_t(cell.firstBlade) + i;
            const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
            const shared::PosedBlade posed = field::restingBlade(field, table, calm, blade);
            poses[index] = {posed.v0, posed.v1, posed.v2, posed.axis};
        }
    });
    return poses;
}

} // namespace sward::trace
