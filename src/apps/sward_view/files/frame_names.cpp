#include "apps/sward_view/files/frame_names.h"

#include "core/error.h"

#include <fmt/core.h>

namespace sward::view {
namespace {

constexpr std::size_t maxDigits = 2; ///< of the width in %04d

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

} // namespace

FrameNames::FrameNames(const std::string& pattern, bool mayBeExr, bool mayBeNpz)
    : isExr_(mayBeExr && pattern.ends_with(".exr"))
    , isNpz_(mayBeNpz && pattern.ends_with(".npz"))
{
    if (!isExr_ && !isNpz_ && !pattern.ends_with(".png"))
        fail(ErrorKind::usage, "-o: '{}' does not end in {}", pattern,
             mayBeNpz   ? ".png, .exr or .npz, the formats that are written"
             : mayBeExr ? ".png or .exr, the formats that are written"
                        : ".png, the one format that is written");
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = numbered_ ? after_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
            continue;
        }
        if (i + 1 < pattern.size() && pattern[i + 1] == '%') {
            part += '%';
            ++i;
            continue;
        }
        // Parse a width, with an optional leading zero, and a d.
        std::size_t end = i + 1;
        while (end < pattern.size() && isDigit(pattern[end]))
            ++end;
        const std::string width = pattern.substr(i + 1, end - i - 1);
        if (end == pattern.size() || pattern[end] != 'd' || width.size() > maxDigits || numbered_)
            fail(ErrorKind::usage,
                 "-o: '{}' is not a pattern; one number like %d or %04d may be in it", pattern);
        digits_ = width.empty() ? 0 : std::stoi(width);
        numbered_ = true;
        i = end;
    }
}

const char* FrameNames::extension() const
{
    return isExr_ ? ".exr" : isNpz_ ? ".npz" : ".png";
}

std::filesystem::path FrameNames::of(std::uint64_t frame) const
{
    if (!numbered_)
        return before_;
    return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

} // namespace sward::view
