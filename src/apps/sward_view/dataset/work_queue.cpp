#include "apps/sward_view/dataset/work_queue.h"

#include <utility>

namespace sward::view {

WorkQueue::WorkQueue(std::size_t threads)
{
    for (std::size_t i = 0; i < threads; ++i)
        threads_.emplace_back([this] { work(); });
}

WorkQueue::~WorkQueue()
{
    {
        const std::lock_guard lock(mutex_);
        waiting_.clear();
        isEnding_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

/// Needs the lock.
void WorkQueue::rethrow()
{
    if (failure_)
        std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WorkQueue::add(std::function<void()> task)
{
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return waiting_.size() < threads_.size() || failure_; });
        rethrow();
        waiting_.push_back(std::move(task));
    }
    changed_.notify_all();
}

void WorkQueue::finish()
{
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return (waiting_.empty() && working_ == 0) || failure_; });
    rethrow();
}

void WorkQueue::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return isEnding_ || !waiting_.empty(); });
        if (isEnding_)
            return;
        const std::function<void()> task = std::move(waiting_.front());
        waiting_.pop_front();
        ++working_;
        lock.unlock();
        changed_.notify_all();
        std::exception_ptr failure;
        try {
            task();
        } catch (...) {
            // Rethrown where tasks are added.
            failure = std::current_exception();
        }
        lock.lock();
        --working_;
        if (failure && !failure_)
            failure_ = failure;
        changed_.notify_all();
    }
}

} // namespace sward::view
