#include "apps/sward_view/paint/autosave_writer.h"

#include "core/error.h"

#include <utility>

namespace sward::view {
namespace {

constexpr std::chrono::seconds autosaveAgain{5}; ///< between two tries that fail

} // namespace

AutosaveWriter::AutosaveWriter(Autosave autosave, const StrokeList& strokes)
    : autosave_(std::move(autosave))
    , revision_(strokes.finishedRevision())
{
}

void AutosaveWriter::follow(const StrokeList& strokes)
{
    const auto now = std::chrono::steady_clock::now();
    if (writing_.valid()) {
        if (writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        take(writing_.get());
    }
    const bool isNew = revision_ != strokes.finishedRevision();
    const bool isAgain = !trouble_.empty() && now >= next_;
    if (strokes.isGrowing() || !(isNew || isAgain))
        return;
    revision_ = strokes.finishedRevision();
    isDiscarded_ = false;
    next_ = now + autosaveAgain;
    if (!strokes.isUnsaved())
        return remove();
    writing_ = std::async(std::launch::async, [this, text = strokeFileText(strokes.finished())] {
        try {
            autosave_.write(text);
            return std::string();
        } catch (const Error& error) {
            return std::string(error.what());
        }
    });
}

std::filesystem::path AutosaveWriter::finish(const StrokeList& strokes)
{
    if (isDiscarded_)
        return {};
    // The one under way, then one of what has changed since it began.
    for (int i = 0; i < 2; ++i) {
        if (writing_.valid())
            writing_.wait();
        next_ = {};
        follow(strokes);
    }
    if (writing_.valid())
        take(writing_.get());
    return autosave_.path();
}

void AutosaveWriter::discard(const StrokeList& strokes)
{
    remove();
    revision_ = strokes.finishedRevision();
    isDiscarded_ = true;
}

// Tells a trouble once, however often it comes.
void AutosaveWriter::take(std::string trouble)
{
    if (!trouble.empty() && trouble_.empty())
        newTrouble_ = trouble + ". The strokes are not saved by themselves until that is possible "
                                "again; 'Save strokes...' writes them elsewhere.";
    trouble_ = std::move(trouble);
}

void AutosaveWriter::remove()
{
    if (writing_.valid())
        writing_.get();
    autosave_.remove();
    trouble_.clear();
}

} // namespace sward::view
