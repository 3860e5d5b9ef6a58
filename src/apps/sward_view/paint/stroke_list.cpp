#include "apps/sward_view/paint/stroke_list.h"

#include <glm/geometric.hpp>

#include <iterator>
#include <utility>

namespace sward::view {
namespace {

constexpr double shortestStep = 0.25; ///< [radii] between two points

StrokeList::Entry entryOf(const std::string& text, bool visible)
{
    const StrokeSketch sketch = sketchOf(text);
    return {sketch.kind,     text,           visible, sketch.name, sketch.radius,
            sketch.length(), sketch.middle()};
}

} // namespace

void StrokeList::reset(const std::vector<std::string>& strokes, bool saved)
{
    entries_.clear();
    changes_.clear();
    before_.clear();
    done_ = 0;
    growing_.reset();
    for (const std::string& text : strokes)
        entries_.push_back(entryOf(text, true));
    end_.reset();
    finishedRevision_ = revision_ = ++lastRevision_;
    saved_ = saved ? finishedRevision_ : 0;
}

void StrokeList::begin(const Brush& brush, const PaintPoint& point)
{
    finish();
    growing_ = Growing{brush, {point}, strokeText(brush, {point})};
    end_ = point;
    revision_ = ++lastRevision_;
}

bool StrokeList::extend(const PaintPoint& point)
{
    if (!growing_)
        return false;
    const auto step = shortestStep * static_cast<double>(growing_->brush.radius);
    if (glm::distance(point.place, growing_->points.back().place) < step)
        return false;
    growing_->points.push_back(point);
    end_ = point;
    growing_->text = strokeText(growing_->brush, growing_->points);
    revision_ = ++lastRevision_;
    return true;
}

bool StrokeList::finish()
{
    if (!growing_)
        return false;
    const Growing grown = std::move(*growing_);
    growing_.reset();
    record({Change::Kind::comes, entries_.size(), entryOf(grown.text, true)});
    return true;
}

void StrokeList::draw(const Brush& brush, const std::vector<PaintPoint>& points)
{
    if (points.empty())
        return;
    begin(brush, points.front());
    for (const PaintPoint& point : points)
        extend(point);
    // However near the last one is.
    growing_->points.back() = points.back();
    growing_->text = strokeText(brush, growing_->points);
    end_ = points.back();
    finish();
}

void StrokeList::replace(const std::vector<Replacement>& others)
{
    finish();
    Change change{Change::Kind::isReplaced};
    for (const Replacement& one : others)
        if (const Entry& entry = entries_.at(one.index); entry.text != one.text)
            change.others.emplace_back(one.index, entryOf(one.text, entry.visible));
    if (!change.others.empty())
        record(std::move(change));
}

void StrokeList::rename(std::size_t index, const std::string& name)
{
    replace({{index, withName(entries_.at(index).text, name)}});
}

void StrokeList::setVisible(std::size_t index, bool visible)
{
    finish();
    if (entries_.at(index).visible != visible)
        record({Change::Kind::isSwitched, index});
}

void StrokeList::remove(std::size_t index)
{
    finish();
    end_.reset();
    record({Change::Kind::goes, index, entries_.at(index)});
}

void StrokeList::record(Change change)
{
    changes_.resize(done_);
    before_.resize(done_);
    before_.push_back(finishedRevision_);
    changes_.push_back(std::move(change));
    apply(changes_[done_++], true);
    finishedRevision_ = revision_ = ++lastRevision_;
}

void StrokeList::apply(Change& change, bool forward)
{
    for (auto& [index, entry] : change.others)
        std::swap(entries_[index], entry);
    if (change.kind == Change::Kind::isReplaced)
        return;
    const auto at = entries_.begin() + static_cast<std::ptrdiff_t>(change.index);
    if (change.kind == Change::Kind::isSwitched)
        at->visible = !at->visible;
    else if ((change.kind == Change::Kind::comes) == forward)
        entries_.insert(at, change.entry);
    else
        entries_.erase(at);
}

bool StrokeList::undo()
{
    finish();
    if (done_ == 0)
        return false;
    end_.reset();
    apply(changes_[--done_], false);
    // The list is what it was, and so is whether a file holds it.
    std::swap(finishedRevision_, before_[done_]);
    revision_ = ++lastRevision_;
    return true;
}

bool StrokeList::redo()
{
    finish();
    if (done_ == changes_.size())
        return false;
    end_.reset();
    std::swap(finishedRevision_, before_[done_]);
    apply(changes_[done_++], true);
    revision_ = ++lastRevision_;
    return true;
}

std::vector<std::string> StrokeList::finished() const
{
    std::vector<std::string> texts;
    for (const Entry& entry : entries_)
        if (entry.visible)
            texts.push_back(entry.text);
    return texts;
}

std::vector<std::string> StrokeList::visible() const
{
    std::vector<std::string> texts = finished();
    if (growing_)
        texts.push_back(growing_->text);
    return texts;
}

} // namespace sward::view
