#include "apps/sward/files/line_input.h"

#include "apps/common/interrupt.h"
#include "core/process/arriving_bytes.h"

#include <algorithm>
#include <chrono>

namespace sward::apps {
namespace {

constexpr std::chrono::milliseconds patience{100}; // until requests to end are looked for

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
        const std::optional<std::size_t> got = readArriving(descriptor_, buffer_, patience);
        if (!got)
            continue;
        begin_ = 0;
        end_ = *got;
        return *got > 0;
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
