#pragma once

#include "apps/sward_view/paint/edit_session.h"
#include "apps/sward_view/paint/stroke_list.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sward::view {

/// The strokes of a session that touch no ground, or not with all of them, by their texts.
class LostStrokes {
public:
    /// What the session tells of its strokes `held`, from number `first` on.
    void take(const std::vector<std::string>& held, const std::vector<LostStroke>& lost,
              std::size_t first)
    {
        for (std::size_t i = first; i < held.size() && !byText_.empty(); ++i)
            byText_.erase(held[i]);
        for (const LostStroke& one : lost)
            if (one.stroke < held.size())
                byText_[held[one.stroke]] = one;
    }

    /// What is lost of a stroke of this text; null: nothing.
    const LostStroke* of(const std::string& text) const
    {
        const auto found = byText_.find(text);
        return found == byText_.end() ? nullptr : &found->second;
    }

    /// Number of visible strokes of a list of which something is lost.
    std::size_t countIn(const StrokeList& strokes) const
    {
        if (byText_.empty())
            return 0;
        const auto& entries = strokes.entries();
        return static_cast<std::size_t>(
            std::count_if(entries.begin(), entries.end(), [this](const StrokeList::Entry& entry) {
                return entry.visible && of(entry.text) != nullptr;
            }));
    }

private:
    std::map<std::string, LostStroke> byText_;
};

} // namespace sward::view
