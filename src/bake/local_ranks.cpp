#include "bake/local_ranks.h"

#include "core/expect.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>

namespace sward::bake {
namespace {

// A cell with so many roots has ranks of its own; one with fewer looks around.
constexpr std::size_t few = 2000;

} // namespace

LocalRanks::LocalRanks(const glm::dvec3& origin, const Roots& roots,
                       const std::vector<std::uint64_t>& order)
{
    // Roots lie in spatial order: the cell of a run is looked up once. First those inside, then,
    // for cells with few, those around.
    CellNumber last = {};
    std::vector<std::uint64_t>* lastOrders = nullptr;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const glm::vec3 place = roots[i].position;
        const CellNumber own = cellOf(origin, place);
        if (lastOrders == nullptr || own != last) {
            lastOrders = &orders_[packCell(own)];
            last = own;
        }
        lastOrders->push_back(order[i]);
    }
    std::unordered_map<std::uint64_t, bool> isFew;
    for (const auto& [cell, orders] : orders_)
        isFew[cell] = orders.size() < few;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const glm::vec3 place = roots[i].position;
        const CellNumber own = cellOf(origin, place);
        const CellNumber low = cellOf(origin, place - static_cast<float>(reach));
        const CellNumber high = cellOf(origin, place + static_cast<float>(reach));
        if (low == own && high == own)
            continue;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    if (const CellNumber cell{x, y, z}; cell != own) {
                        const auto found = isFew.find(packCell(cell));
                        if (found != isFew.end() && found->second)
                            orders_[packCell(cell)].push_back(order[i]);
                    }
    }
    tbb::parallel_for_each(orders_,
                           [](auto& cell) { std::sort(cell.second.begin(), cell.second.end()); });
}

float LocalRanks::rank(const CellNumber& cell, std::uint64_t order) const
{
    const auto found = orders_.find(packCell(cell));
    expect(found != orders_.end(), "the cell holds roots");
    const std::vector<std::uint64_t>& orders = found->second;
    const auto before = std::lower_bound(orders.begin(), orders.end(), order) - orders.begin();
    return static_cast<float>(double(before) / double(orders.size()));
}

} // namespace sward::bake
