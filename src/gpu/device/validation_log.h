#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace sward::gpu {

/// Messages of the validation layers: warnings and errors, collected from any thread.
class ValidationLog {
public:
    void add(std::string message);
    void clear();

    std::size_t count() const;

    /// All messages, one per line; empty if there are none. Beyond the first hundred messages only
    /// the count grows.
    std::string text() const;

private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    std::size_t count_ = 0;
};

} // namespace sward::gpu
