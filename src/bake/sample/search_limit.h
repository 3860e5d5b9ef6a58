#pragma once

#include "core/error.h"

#include <chrono>
#include <cstdint>

namespace sward::bake {

/// Time that the search for a count may take. It decides only whether there is a result, never
/// which one.
class SearchLimit {
public:
    /// Begins now. Large counts have more time.
    explicit SearchLimit(std::uint64_t count)
        : count_(count)
        , end_(Clock::now() + std::chrono::seconds(15) + std::chrono::microseconds(50 * count))
    {
    }

    /// Throws Error{input} naming --count if the time is over.
    void require() const
    {
        if (Clock::now() > end_)
            fail(ErrorKind::input,
                 "--count {}: not found in time: the filters keep little, or the triangles are "
                 "slivers; ask for fewer, for a --density, or for --sampling uniform",
                 count_);
    }

private:
    using Clock = std::chrono::steady_clock;
    std::uint64_t count_;
    Clock::time_point end_;
};

} // namespace sward::bake
