#include "field/poses/blade_poses.h"

#include "field/measure/resting_blade.h"
#include "field/organs.h"
#include "shaders/shared/organ.h"

#include <algorithm>
#include <future>

namespace sward::field {
namespace {

// Patches of a task; fewer are not worth a thread.
constexpr std::size_t minPatchesOfTask = 64;

} // namespace

std::vector<BladePose> restingPoses(const FieldView& field, unsigned threads)
{
    const shared::Environment calm = calmOf(field);
    const std::vector<shared::Organ> organs = organTable(field.species);
    const shared::OrganTable table = viewOf(organs);
    std::vector<BladePose> poses(field.blades.size());
    const auto poseAll = [&](std::span<const shared::Patch> patches) {
        for (const shared::Patch& cell : patches)
            for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                const std::size_t index = std::size_t(cell.firstBlade) + i;
                const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
                const shared::PosedBlade posed = restingBlade(field, table, calm, blade);
                poses[index] = {posed.v0, posed.v1, posed.v2, posed.axis};
            }
    };
    const std::size_t count = field.patches.size();
    const std::size_t share =
        std::max(minPatchesOfTask, (count + threads - 1) / std::max(threads, 1U));
    std::vector<std::future<void>> tasks;
    for (std::size_t first = share; first < count; first += share)
        tasks.push_back(std::async(std::launch::async, poseAll,
                                   field.patches.subspan(first, std::min(share, count - first))));
    poseAll(field.patches.first(std::min(share, count)));
    for (std::future<void>& task : tasks)
        task.get();
    return poses;
}

void setAxes(const FieldView& field, std::span<BladePose> poses)
{
    const std::vector<shared::Organ> organs = organTable(field.species);
    for (const shared::Patch& cell : field.patches) {
        // A ribbon stands behind its stalk and has the stalk's data, but its own curve does not say
        // how its stalk stands.
        shared::PosedBlade stalk = {};
        bool hasStalk = false;
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            BladePose& pose = poses[std::size_t(cell.firstBlade) + i];
            const shared::Blade blade =
                shared::unpackBlade(field.blades[std::size_t(cell.firstBlade) + i], cell);
            const shared::Species& look = field.species[blade.species].look;
            pose.axis = shared::widthAxis(blade.up, blade.facing);
            const std::uint32_t number = shared::ribbonNumber(look, blade);
            if (number == 0) {
                stalk.blade = blade;
                stalk.v0 = pose.v0;
                stalk.v1 = pose.v1;
                stalk.v2 = pose.v2;
                stalk.axis = pose.axis;
                hasStalk = true;
            } else if (hasStalk) {
                shared::PosedBlade plant = stalk;
                plant.blade = blade;
                pose.axis = shared::ribbonOf(viewOf(organs), look, plant, number).axis;
            }
        }
    }
}

} // namespace sward::field
