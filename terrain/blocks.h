#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace sward::terrain {

/// Calls `work(begin, end)` for blocks of at most `size` numbers below `count`, from several
/// threads. A block begins at a multiple of `size`.
template <typename Work>
void forEachBlock(std::size_t count, std::size_t size, Work&& work)
{
    const std::size_t blocks = (count + size - 1) / size;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const auto& range) {
        for (std::size_t block = range.begin(); block != range.end(); ++block)
            work(block * size, std::min(count, (block + 1) * size));
    });
}

/// Whether `holds(i)` for every number below `count`; called from several threads.
template <typename Condition>
bool holdsForAll(std::size_t count, Condition&& holds)
{
    constexpr std::size_t size = 4096;
    std::atomic<bool> all = true;
    forEachBlock(count, size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && all.load(std::memory_order_relaxed); ++i)
            if (!holds(i))
                all.store(false, std::memory_order_relaxed);
    });
    return all;
}

} // namespace sward::terrain
