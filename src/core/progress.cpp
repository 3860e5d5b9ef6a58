#include "core/progress.h"

#include "core/error.h"

namespace sward {

void Progress::begin(const std::string& stage, std::uint64_t total)
{
    throwIfCancelled();
    stage_ = stage;
    total_ = total;
    done_.store(0, std::memory_order_relaxed);
    if (callback_)
        callback_(stage_, 0.0);
}

void Progress::advance(std::uint64_t steps)
{
    throwIfCancelled();
    const std::uint64_t before = done_.fetch_add(steps, std::memory_order_relaxed);
    if (!callback_ || total_ == 0)
        return;
    // Report when the count crosses a whole per cent.
    const std::uint64_t after = before + steps;
    if (before * 100 / total_ != after * 100 / total_)
        callback_(stage_, static_cast<double>(after) / static_cast<double>(total_));
}

void Progress::throwIfCancelled() const
{
    if (isCancelled())
        fail(ErrorKind::interrupted, "interrupted during {}", stage_.empty() ? "start" : stage_);
}

} // namespace sward
