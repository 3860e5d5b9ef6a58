#pragma once

#include "apps/sward_view/paint/autosave.h"
#include "apps/sward_view/paint/stroke_list.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <future>
#include <string>
#include <utility>

namespace sward::view {

/// Keeps an autosave at the finished strokes of a list, in the background.
class AutosaveWriter {
public:
    /// The strokes as they are now need not be written.
    AutosaveWriter(Autosave autosave, const StrokeList& strokes);

    /// Writes what has changed, and what could not be written some seconds ago; removes the file of
    /// strokes that are saved. Never waits.
    void follow(const StrokeList& strokes);

    /// The same, but waits. Returns the file; empty: nothing is written.
    std::filesystem::path finish(const StrokeList& strokes);

    /// Removes the file. What is there now is written no more.
    void discard(const StrokeList& strokes);

    bool isWriting() const { return writing_.valid(); }

    /// Why the file does not hold the strokes; empty: it does, or they are saved.
    const std::string& trouble() const { return trouble_; }

    /// That reason when it is new, once.
    std::string takeTrouble() { return std::exchange(newTrouble_, {}); }

private:
    void take(std::string trouble);
    void remove();

    Autosave autosave_;
    std::uint64_t revision_; ///< of finished strokes that were written last
    std::string trouble_;
    std::string newTrouble_;
    std::chrono::steady_clock::time_point next_; ///< try after one that failed
    bool isDiscarded_ = false;
    std::future<std::string> writing_; ///< writes the file; its error, or nothing
};

} // namespace sward::view
