#include "bake/patches/local_ranks.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>

namespace sward::bake {
namespace {

// Cells with at least this number of roots use their own ranks; others include their surroundings.
constexpr std::size_t few = 2000;

constexpr std::size_t askEvery = 65'536; // roots between two looks at the progress

} // namespace

LocalRanks::LocalRanks(const glm::dvec3& origin, const Roots& roots,
                       const std::vector<std::uint64_t>& order, const Progress& progress)
{
    // Roots are in spatial order, so one lookup serves a run of roots in the same cell.
    tbb::enumerable_thread_specific<std::unordered_map<std::uint64_t, std::size_t>> partial;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 65'536),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          CellNumber last = {};
                          std::size_t* count = nullptr;
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              const CellNumber own = cellOf(origin, roots[i].position);
                              if (count == nullptr || own != last) {
                                  count = &partial.local()[packCell(own)];
                                  last = own;
                              }
                              ++*count;
                          }
                      });
    std::unordered_map<std::uint64_t, std::size_t> counts;
    for (const auto& part : partial)
        for (const auto& [cell, own] : part)
            counts[cell] += own;
    for (const auto& [cell, own] : counts)
        if (own < few)
            orders_[cell];
    if (orders_.empty())
        return;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        if (i % askEvery == 0)
            progress.throwIfCancelled();
        const glm::vec3 place = roots[i].position;
        const CellNumber low = cellOf(origin, place - static_cast<float>(reach));
        const CellNumber high = cellOf(origin, place + static_cast<float>(reach));
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    if (const auto found = orders_.find(packCell({x, y, z}));
                        found != orders_.end())
                        found->second.push_back(order[i]);
    }
    tbb::parallel_for_each(orders_, [&](auto& cell) {
        progress.throwIfCancelled();
        std::sort(cell.second.begin(), cell.second.end());
    });
}

const std::vector<std::uint64_t>* LocalRanks::around(const CellNumber& cell) const
{
    const auto found = orders_.find(packCell(cell));
    return found == orders_.end() ? nullptr : &found->second;
}

} // namespace sward::bake
