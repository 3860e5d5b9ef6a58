#pragma once

#include <cstdint>

namespace sward::view {

/// Decides what a slow device draws: coarse pictures while something changes; after that a fine
/// picture in some passes over all pixels, while time stands still; then nothing.
class AtRest {
public:
    enum class Draws { moving, refined, nothing };

    static constexpr double delay = 0.5; ///< [s] without a change until the first pass
    static constexpr std::uint32_t passes = 16;

    /// Reports the state at `now` [s, ascending]: whether anything that the picture shows has
    /// changed since the last call. Returns what is drawn next. A change takes effect at once.
    Draws next(double now, bool hasChanged)
    {
        if (hasChanged || changedAt_ < 0.0) {
            changedAt_ = now;
            passesDone_ = 0;
        }
        isResting_ = now - changedAt_ >= delay;
        if (!isResting_)
            return Draws::moving;
        return passesDone_ < passes ? Draws::refined : Draws::nothing;
    }

    /// Reports that a pass has covered the picture.
    void finishPass() { ++passesDone_; }

    /// Whether the last call of next() found rest. The field's time stands still then.
    bool isResting() const { return isResting_; }

    /// Passes of the fine picture so far; 0 while something changes.
    std::uint32_t passesDone() const { return passesDone_; }

private:
    double changedAt_ = -1.0; ///< [s]; below 0: next() was not called yet
    std::uint32_t passesDone_ = 0;
    bool isResting_ = false;
};

} // namespace sward::view
