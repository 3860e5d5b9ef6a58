#pragma once

#include <optional>
#include <string>

namespace sward::bake {

/// An end of a range that is not there.
inline constexpr double unbounded = 1e300;

/// A range with soft edges: 1 inside [low, high], falling to 0 over `soft` outside.
struct SoftRange {
    double low = -unbounded;
    double high = unbounded;
    double soft = 0.0;

    /// Share [0, 1] of the density that stays at `value`.
    double weight(double value) const;

    /// Whether all of [first, last] has weight 1.
    bool holds(double first, double last) const { return low <= first && high >= last; }
};

/// "MIN:MAX" or "MIN:MAX~SOFT"; an end that is left out is that of `full`. None if the text is
/// something else, the ends are the wrong way round, or SOFT is negative.
std::optional<SoftRange> readSoftRange(const std::string& text, const SoftRange& full);

/// The text that readSoftRange() reads back.
std::string textOf(const SoftRange& range);

/// The same of an option. Throws Error{usage} naming `option`.
SoftRange parseSoftRange(const std::string& option, const std::string& text, SoftRange full);

/// "M" or "M~SOFT" of an option: nothing up to M, everything from M + SOFT on. Throws Error{usage}.
SoftRange parseSoftMinimum(const std::string& option, const std::string& text);

} // namespace sward::bake
