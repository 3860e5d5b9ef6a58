#include "apps/sward/files/line_input.h"

#include "apps/common/interrupt.h"
#include "core/error.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace sward::apps {
namespace {

constexpr int maxWait = 100; // [ms] until signals are looked for

} // namespace

LineInput::LineInput(int descriptor, std::size_t longest)
    : descriptor_(descriptor)
    , longest_(longest)
    , buffer_(1 << 16)
{
}

// Reads more bytes once all are used. False at the end.
bool LineInput::fill()
{
    while (!interruptRequested()) {
        // A signal that comes just before a read would not end it.
        pollfd waiting{descriptor_, POLLIN, 0};
        if (::poll(&waiting, 1, maxWait) <= 0)
            continue;
        const ssize_t got = ::read(descriptor_, buffer_.data(), buffer_.size());
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail(ErrorKind::io, "standard input: cannot read: {}", std::strerror(errno));
        begin_ = 0;
        end_ = static_cast<std::size_t>(got);
        return got > 0;
    }
    return false;
}

std::optional<LineInput::Line> LineInput::next()
{
    Line line;
    bool hasBegun = false;
    for (;;) {
        if (begin_ == end_ && !fill())
            return hasBegun && !interruptRequested() ? std::optional(line) : std::nullopt;
        hasBegun = true;
        const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
        const auto last = buffer_.begin() + static_cast<std::ptrdiff_t>(end_);
        const auto lineEnd = std::find(first, last, '\n');
        if (!line.isTooLong)
            line.text.append(first, lineEnd);
        if (line.text.size() > longest_) {
            line.isTooLong = true;
            line.text = {};
        }
        begin_ += static_cast<std::size_t>(lineEnd - first);
        if (lineEnd != last) {
            ++begin_;
            return line;
        }
    }
}

} // namespace sward::apps
