#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace sward::gpu {

/// What the validation layers had to say: warnings and errors, gathered from any thread.
class ValidationLog {
public:
    void add(std::string message);
    void clear();

    std::size_t count() const;

    /// All messages, one under the other; empty if there are none. Beyond the first hundred
    /// messages only the number grows.
    std::string text() const;

private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::size_t count_ = 0;
};

} // namespace sward::gpu
