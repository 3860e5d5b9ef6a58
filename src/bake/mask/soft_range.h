#pragma once

#include <optional>
#include <string>

namespace sward::bake {

/// Marks an open end of a range.
inline constexpr double unbounded = 1e300;

/// A range with soft edges: 1 inside [low, high], falling to 0 over `soft` outside.
struct SoftRange {
    double low = -unbounded;
    double high = unbounded;
    double soft = 0.0;

    /// Weight in [0, 1] at `value`.
    double weight(double value) const;

    /// Whether the weight is 1 on all of [first, last].
    bool holds(double first, double last) const { return low <= first && high >= last; }
};

/// Parses "MIN:MAX" or "MIN:MAX~SOFT"; an omitted end is taken from `full`. Returns none for any
/// other text, swapped ends, or a negative SOFT.
std::optional<SoftRange> readSoftRange(const std::string& text, const SoftRange& full);

/// The text that readSoftRange() reads back.
std::string textOf(const SoftRange& range);

/// As readSoftRange(), for an option. Throws Error{usage} naming `option`.
SoftRange parseSoftRange(const std::string& option, const std::string& text, SoftRange full);

/// Parses "M" or "M~SOFT": weight 0 up to M, 1 from M + SOFT on. Throws Error{usage}.
SoftRange parseSoftMinimum(const std::string& option, const std::string& text);

} // namespace sward::bake
