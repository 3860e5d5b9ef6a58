#include "core/process/child_process.h"

#include <thread>

namespace sward {
namespace {

// Between two questions for the end of a child. Short beside the start of a process.
constexpr std::chrono::milliseconds endPoll{2};

} // namespace

std::optional<ChildProcess::End> ChildProcess::endWithin(std::chrono::milliseconds patience)
{
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        if (std::optional<End> ended = end())
            return ended;
        if (std::chrono::steady_clock::now() >= until)
            return std::nullopt;
        std::this_thread::sleep_for(endPoll);
    }
}

ChildResult runChild(const std::vector<std::string>& arguments)
{
    ChildProcess child(arguments);
    std::string said;
    for (;;) {
        // In this order: what it says at last is read after its end.
        const std::optional<ChildProcess::End> end = child.endWithin(endPoll);
        said += child.said();
        if (end)
            return {std::move(said), *end};
    }
}

} // namespace sward
