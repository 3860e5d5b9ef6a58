#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace sward {

/// Progress of a long piece of work. Any number of worker threads count steps. The caller observes
/// them through the callback and may cancel.
class Progress {
public:
    /// Called with the stage's name and the share done in [0, 1], at most about 100 times per
    /// stage, from the thread that crossed the mark.
    using Callback = std::function<void(const std::string& stage, double share)>;

    /// Without a callback, progress is not reported.
    explicit Progress(Callback callback = {})
        : callback_(std::move(callback))
    {
    }

    /// Begins a stage of `total` steps. Throws Error{interrupted} if cancelled.
    void begin(const std::string& stage, std::uint64_t total);

    /// Counts `steps` more. Throws Error{interrupted} if cancelled.
    void advance(std::uint64_t steps);

    /// Makes the next advance() or begin() throw. Safe from a signal handler.
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    /// Whether cancel() has been called.
    bool isCancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

    /// Throws Error{interrupted} if cancel() has been called.
    void throwIfCancelled() const;

private:
    Callback callback_;
    std::string stage_;
    std::uint64_t total_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<bool> cancelled_ = false;
};

} // namespace sward
