#include "render/sowing/sow_choice.h"

#include "core/expect.h"
#include "shaders/shared/visibility.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <tuple>

namespace sward::render {
namespace {

/// Largest share of the blades that any eye draws in a box.
float shareIn(const Aabb& box, std::span<const shared::Eyepoint> eyes)
{
    float share = 0.0f;
    for (const shared::Eyepoint& eye : eyes) {
        const float distance = shared::boxDistance(eye.eye, box.low, box.high);
        if ((eye.cullMask & shared::cullDistance) == 0 || distance <= eye.drawDistance)
            share = std::max(share, shared::shareAt(eye, distance));
    }
    return share;
}

} // namespace

SowChoice::SowChoice(const field::SeedsView& seeds)
    : seeds_(&seeds)
    , firstLevel_(0)
{
    const std::uint32_t levels = seeds.meadow->levels;
    while (firstLevel_ <= levels &&
           field::lowestRank(firstLevel_, 0, levels) < static_cast<float>(seeds.meadow->stored))
        ++firstLevel_;
    for (const field::SeedEntry& entry : seeds.cells)
        add(entry.cell);
}

std::size_t SowChoice::add(const std::array<std::int32_t, 3>& cell)
{
    const auto [found, isNew] = indices_.try_emplace(cell, cells_.size());
    if (isNew)
        cells_.push_back(cell);
    return found->second;
}

bool SowChoice::mayBear(const field::SowUnit& unit) const
{
    const auto known = bearing_.find(unit.cell);
    if (known == bearing_.end())
        return true;
    const std::array<std::uint8_t, 3> place{static_cast<std::uint8_t>(unit.place[0]),
                                            static_cast<std::uint8_t>(unit.place[1]),
                                            static_cast<std::uint8_t>(unit.place[2])};
    const auto& places = known->second[field::unitLevel(unit.level)];
    return std::ranges::find(places, place) != places.end();
}

void SowChoice::findIn(std::size_t index, std::span<const shared::Eyepoint> eyes,
                       std::vector<Wanted>& wanted) const
{
    const std::uint32_t levels = seeds_->meadow->levels;
    field::SowUnit unit;
    unit.cell = cells_[index];
    const float most = shareIn(field::boxOf(unit), eyes);
    if (firstLevel_ > levels || most <= field::lowestRank(firstLevel_, 0, levels))
        return;
    const auto known = bearing_.find(unit.cell);
    if (known == bearing_.end()) {
        wanted.push_back({most / field::lowestRank(firstLevel_, 0, levels), true, unit});
        return;
    }
    for (unit.level = firstLevel_; unit.level <= levels; ++unit.level) {
        if (most <= field::lowestRank(unit.level, 0, levels))
            return;
        for (const std::array<std::uint8_t, 3>& place :
             known->second[field::unitLevel(unit.level)]) {
            unit.place = {place[0], place[1], place[2]};
            const float share = shareIn(field::boxOf(unit), eyes);
            for (unit.half = 0; unit.half < 2; ++unit.half) {
                const float lowest = field::lowestRank(unit.level, unit.half, levels);
                if (share > lowest)
                    wanted.push_back({share / lowest, false, unit});
            }
        }
    }
}

void SowChoice::find(std::span<const shared::Eyepoint> eyes, std::vector<Wanted>& wanted) const
{
    wanted.clear();
    for (std::size_t i = 0; i < cells_.size(); ++i)
        findIn(i, eyes, wanted);
    std::ranges::sort(wanted, [](const Wanted& a, const Wanted& b) {
        return std::tie(b.score, a.unit) < std::tie(a.score, b.unit);
    });
}

float SowChoice::scoreOf(const field::SowUnit& unit, std::span<const shared::Eyepoint> eyes) const
{
    return shareIn(field::boxOf(unit), eyes) /
           field::lowestRank(unit.level, unit.half, seeds_->meadow->levels);
}

void SowChoice::know(const std::array<std::int32_t, 3>& cell, const field::UnitCell::Cubes& cubes)
{
    Bearing& bearing = bearing_[cell];
    field::SowUnit unit;
    for (std::uint32_t fine = 0; fine < bearing.size(); ++fine) {
        bearing[fine].clear();
        unit.level = fine == 0 ? 0 : fine + 3;
        const std::uint32_t side = 1U << fine;
        for (unit.place[2] = 0; unit.place[2] < side; ++unit.place[2])
            for (unit.place[1] = 0; unit.place[1] < side; ++unit.place[1])
                for (unit.place[0] = 0; unit.place[0] < side; ++unit.place[0])
                    if (field::bears(cubes, unit))
                        bearing[fine].push_back({static_cast<std::uint8_t>(unit.place[0]),
                                                 static_cast<std::uint8_t>(unit.place[1]),
                                                 static_cast<std::uint8_t>(unit.place[2])});
    }
}

std::size_t SowChoice::indexOf(const std::array<std::int32_t, 3>& cell) const
{
    const auto found = indices_.find(cell);
    expect(found != indices_.end(), "a cell of the seeds");
    return found->second;
}

} // namespace sward::render
