#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sward::view {

/// Threads that carry out tasks in any order, while the caller makes more.
class WorkQueue {
public:
    /// `threads`: at least 1.
    explicit WorkQueue(std::size_t threads);
    WorkQueue(const WorkQueue&) = delete;
    WorkQueue& operator=(const WorkQueue&) = delete;
    ~WorkQueue(); ///< drops tasks that have not begun

    /// Waits while there are as many tasks waiting as threads. Throws what a task has thrown.
    void add(std::function<void()> task);

    /// Waits for all tasks. Throws what a task has thrown.
    void finish();

private:
    void work();
    void rethrow();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::size_t working_ = 0;
    bool isEnding_ = false;
    std::exception_ptr failure_; ///< the first
    std::vector<std::thread> threads_;
};

} // namespace sward::view
