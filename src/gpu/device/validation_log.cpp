#include "gpu/device/validation_log.h"

#include <utility>

namespace sward::gpu {
namespace {

// An error in a frame repeats every frame; the first hundred messages suffice to fix it.
constexpr std::size_t keptMessages = 100;

} // namespace

void ValidationLog::add(std::string message)
{
    const std::lock_guard lock(mutex_);
    ++count_;
    if (messages_.size() < keptMessages)
        messages_.push_back(std::move(message));
}

void ValidationLog::clear()
{
    const std::lock_guard lock(mutex_);
    messages_.clear();
    count_ = 0;
}

std::size_t ValidationLog::count() const
{
    const std::lock_guard lock(mutex_);
    return count_;
}

std::string ValidationLog::text() const
{
    const std::lock_guard lock(mutex_);
    std::string text;
    for (const std::string& message : messages_)
        text += message + '\n';
    return text;
}

} // namespace sward::gpu
