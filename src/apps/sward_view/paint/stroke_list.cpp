#include "apps/sward_view/paint/stroke_list.h"

#include <glm/geometric.hpp>

#include <iterator>
#include <utility>

namespace sward::view {
namespace {

constexpr double shortestStep = 0.25; ///< [radii] between two points

} // namespace

void StrokeList::reset(const std::vector<std::string>& strokes, bool saved)
{
    entries_.clear();
    changes_.clear();
    before_.clear();
    done_ = 0;
    growing_.reset();
    for (const std::string& text : strokes)
        entries_.push_back({kindOfStroke(text), text, true});
    finishedRevision_ = revision_ = ++lastRevision_;
    saved_ = saved ? finishedRevision_ : 0;
}

void StrokeList::begin(const Brush& brush, const PaintPoint& point)
{
    finish();
    growing_ = Growing{brush, {point}, strokeText(brush, {point})};
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
    const auto kind = static_cast<std::size_t>(grown.brush.kind);
    record({Change::Kind::comes, entries_.size(), {paintKindNames[kind], grown.text, true}});
    return true;
}

void StrokeList::setVisible(std::size_t index, bool visible)
{
    finish();
    if (entries_.at(index).visible != visible)
        record({Change::Kind::isSwitched, index, {}});
}

void StrokeList::remove(std::size_t index)
{
    finish();
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

void StrokeList::apply(const Change& change, bool forward)
{
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
