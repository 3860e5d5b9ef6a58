#include "lidar/blade_quads.h"

#include "field/organs.h"
#include "field/poses/blade_rows.h"
#include "field/poses/part_look.h"
#include "shaders/shared/lidar/returns.h"

#include <algorithm>
#include <future>

namespace sward::lidar {
namespace {

using Quads = std::vector<shared::RayQuad>;

void addQuads(Quads& quads, const field::PartLook& part, const field::BladePose& pose,
              std::uint32_t index)
{
    const float width = part.blade.width;
    if (!(width > 0.0f) || !(part.blade.height > 0.0f))
        return;
    const bool isFolded = part.look.fold > 0.0f;
    field::BladeRow below;
    bool hasBelow = false;
    for (const float along : field::rowsOf(part.look, pose, width)) {
        const field::BladeRow row = field::rowAt(part.look, pose, width, along);
        const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
            quads.push_back({a, index, b, part.blade.species, c, 0, d, 0});
        };
        if (hasBelow && isFolded) {
            add(below.left, below.ridge, row.ridge, row.left);
            add(below.ridge, below.right, row.right, row.ridge);
        } else if (hasBelow) {
            add(below.left, below.right, row.right, row.left);
        }
        below = row;
        hasBelow = true;
    }
}

void addGroundQuads(Quads& quads, const field::DisplayGround& ground)
{
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        for (std::uint32_t i = 0; i + 2 < range.indexCount; i += 3) {
            const auto corner = [&](std::uint32_t k) {
                return ground.vertices[ground.indices[range.firstIndex + i + k]].position;
            };
            quads.push_back({corner(0), shared::lidarGround, corner(1), shared::rayGroundSurface,
                             corner(1), 0, corner(2), 0});
        }
    }
}

} // namespace

std::vector<shared::RayQuad> quadsOf(const field::FieldView& field,
                                     std::span<const field::BladePose> poses, unsigned threads)
{
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    const shared::OrganTable table = field::viewOf(organs);
    const auto quadsOfPatches = [&](std::span<const shared::Patch> patches) {
        Quads quads;
        for (const shared::Patch& cell : patches)
            for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                const std::uint32_t index = cell.firstBlade + i;
                const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
                addQuads(quads, field::partLookOf(field, table, blade), poses[index], index);
            }
        return quads;
    };
    const std::size_t count = field.patches.size();
    const std::size_t share = std::max<std::size_t>(1, (count + threads - 1) / threads);
    std::vector<std::future<Quads>> tasks;
    for (std::size_t first = 0; first < count; first += share)
        tasks.push_back(std::async(std::launch::async, quadsOfPatches,
                                   field.patches.subspan(first, std::min(share, count - first))));
    Quads quads;
    for (std::future<Quads>& task : tasks) {
        const Quads some = task.get();
        quads.insert(quads.end(), some.begin(), some.end());
    }
    if (field.ground != nullptr)
        addGroundQuads(quads, *field.ground);
    return quads;
}

} // namespace sward::lidar
