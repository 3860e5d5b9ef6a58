#pragma once

#include "apps/sward_view/paint/stroke.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::view {

/// The strokes of a painting, in order, with a switch each, and all changes for undo and redo. One
/// stroke may be growing.
class StrokeList {
public:
    struct Entry {
        std::string kind; ///< keyword
        std::string text; ///< a line of a stroke file
        bool visible = true;
        std::string name{};     ///< empty: none
        double radius = 1.0;    ///< [m]
        double length = 0.0;    ///< [m]
        glm::dvec3 middle{0.0}; ///< world [m]
    };
    const std::vector<Entry>& entries() const { return entries_; }

    /// Takes these strokes instead of all; nothing can be undone then. `saved`: a file holds them.
    void reset(const std::vector<std::string>& strokes, bool saved);

    /// Begins a stroke, after finishing the one that grows.
    void begin(const Brush& brush, const PaintPoint& point);
    /// Adds a point at least a quarter of the radius away from the last; returns whether it did.
    bool extend(const PaintPoint& point);
    /// The growing stroke becomes the last entry; returns whether there was one.
    bool finish();
    bool isGrowing() const { return growing_.has_value(); }
    /// Points of the growing stroke, before it is simplified.
    std::size_t grownPoints() const { return growing_ ? growing_->points.size() : 0; }

    /// Draws a whole stroke through these points, after finishing the one that grows.
    void draw(const Brush& brush, const std::vector<PaintPoint>& points);
    /// Where the last stroke of the brush has ended; none after undo, redo and removal.
    const std::optional<PaintPoint>& end() const { return end_; }

    void setVisible(std::size_t index, bool visible);
    void remove(std::size_t index);

    /// Gives strokes other texts, as one change.
    struct Replacement {
        std::size_t index;
        std::string text;
    };
    void replace(const std::vector<Replacement>& others);
    /// An empty name takes it away.
    void rename(std::size_t index, const std::string& name);

    /// Takes the last change back, or does it again; a growing stroke is finished first. Returns
    /// whether there was one.
    bool undo();
    bool redo();
    bool canUndo() const { return done_ > 0 || isGrowing(); }
    bool canRedo() const { return !isGrowing() && done_ < changes_.size(); }

    /// Text of the visible strokes, and last of the growing one.
    std::vector<std::string> visible() const;
    /// The same without the growing one.
    std::vector<std::string> finished() const;

    /// Differs after each change of visible().
    std::uint64_t revision() const { return revision_; }

    /// The same of finished(): equal for equal lists after undo and redo.
    std::uint64_t finishedRevision() const { return finishedRevision_; }

    /// Whether the finished strokes differ from those that were saved last.
    bool isUnsaved() const { return saved_ != finishedRevision_; }
    /// A file holds the finished strokes of this revision.
    void setSaved(std::uint64_t revision) { saved_ = revision; }

private:
    /// An entry comes, goes, or is switched, or some become others.
    struct Change {
        enum class Kind { comes, goes, isSwitched, isReplaced } kind = Kind::comes;
        std::size_t index = 0;
        Entry entry{};
        std::vector<std::pair<std::size_t, Entry>> others{};
    };
    struct Growing {
        Brush brush;
        std::vector<PaintPoint> points;
        std::string text;
    };

    void record(Change change);
    void apply(Change& change, bool forward);

    std::vector<Entry> entries_;
    std::vector<Change> changes_;
    std::size_t done_ = 0; ///< changes that are in force
    std::optional<Growing> growing_;
    std::optional<PaintPoint> end_;
    std::uint64_t revision_ = 0;
    std::uint64_t lastRevision_ = 0;     ///< the highest that was given
    std::uint64_t finishedRevision_ = 0; ///< of the entries
    std::uint64_t saved_ = 0;
    std::vector<std::uint64_t> before_; ///< finishedRevision_ before each change
};

} // namespace sward::view
