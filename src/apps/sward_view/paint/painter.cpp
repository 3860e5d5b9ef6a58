#include "apps/sward_view/paint/painter.h"

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace sward::view {
namespace {

constexpr std::chrono::milliseconds savePoll{5};

} // namespace

Painter::Painter(std::vector<std::string> command, const std::vector<std::string>& held,
                 std::filesystem::path autosave, std::unique_ptr<apps::TemporaryFolder> folder)
    : folder_(std::move(folder))
    , session_(std::move(command))
    , autosave_(std::move(autosave))
    , held_(held)
{
    strokes.reset(held, true);
    heldRevision_ = strokes.revision();
    autosavedRevision_ = strokes.finishedRevision();
}

void Painter::poll(const std::function<void(const std::filesystem::path&)>& apply)
{
    const bool hadReady = session_.isReady();
    const bool hadFailed = !session_.failure().empty();
    session_.poll();
    if (!hadReady && session_.isReady())
        total_ = session_.ready().blades;
    while (const auto answer = session_.take())
        takeAnswer(*answer, apply);
    if (!hadFailed && !session_.failure().empty())
        told_.push_back({true, session_.failure(), {}});
    writeAutosave();
    // Without a session the painting ends, and the autosave has what remains of it.
    if (!session_.failure().empty())
        finishAutosave();
    if (isReady() && under_ == Asked::nothing)
        askNext();
}

bool Painter::isIdle() const
{
    return under_ == Asked::nothing && !mustClear_ && savings_.empty() && !autosaving_.valid() &&
           heldRevision_ == strokes.revision();
}

void Painter::takeAnswer(const EditAnswer& answer,
                         const std::function<void(const std::filesystem::path&)>& apply)
{
    const Asked what = std::exchange(under_, Asked::nothing);
    if (!answer.error.empty())
        told_.push_back({true, answer.error, {}});
    if (what == Asked::paint) {
        // A state that is refused is not asked for again; the next one is.
        heldRevision_ = askedRevision_;
        if (!answer.error.empty())
            return;
        held_ = std::move(asked_);
        total_ = answer.total;
        if (answer.delta.empty())
            return;
        seconds_ = answer.seconds;
        hasPainted_ = true;
        try {
            apply(answer.delta);
        } catch (const Error& error) {
            told_.push_back({true, error.what(), {}});
        }
        std::error_code ignored;
        std::filesystem::remove(answer.delta, ignored);
        return;
    }
    const Saving saved = std::move(savings_.front());
    savings_.erase(savings_.begin());
    if (!answer.error.empty())
        return;
    told_.push_back({false, saved.path.string() + ": written",
                     what == Asked::saveField ? saved.path : std::filesystem::path()});
    if (what == Asked::saveField) {
        field_ = saved.path;
        fieldRevision_ = savedRevision_;
    } else {
        strokes.setSaved(savedRevision_);
        if (!strokes.isUnsaved())
            removeAutosave();
    }
}

void Painter::askNext()
{
    if (mustClear_) {
        mustClear_ = false;
        // The state after it differs from what is held, so that all strokes follow.
        askPaint({}, 0);
    } else if (strokes.revision() != heldRevision_) {
        askPaint(strokes.visible(), strokes.revision());
    } else if (!savings_.empty() && !strokes.isGrowing()) {
        const Saving& saving = savings_.front();
        under_ = saving.what;
        savedRevision_ = strokes.finishedRevision();
        const nlohmann::json keys{{"do", saving.what == Asked::saveField ? "save" : "save_strokes"},
                                  {"path", std::filesystem::absolute(saving.path).string()},
                                  {"overwrite", saving.overwrite}};
        const std::string text = jsonText(keys);
        session_.ask(std::string_view(text).substr(1, text.size() - 2));
    }
}

void Painter::askPaint(const std::vector<std::string>& wanted, std::uint64_t revision)
{
    const auto most = std::min(held_.size(), wanted.size());
    std::size_t keep = 0;
    while (keep < most && held_[keep] == wanted[keep])
        ++keep;
    std::string keys = fmt::format("\"do\":\"paint\",\"keep\":{},\"strokes\":[", keep);
    for (std::size_t i = keep; i < wanted.size(); ++i)
        keys += (i == keep ? "" : ",") + wanted[i];
    under_ = Asked::paint;
    asked_ = wanted;
    askedRevision_ = revision;
    session_.ask(keys + "]");
}

void Painter::saveField(const std::filesystem::path& path, bool overwrite)
{
    savings_.push_back({Asked::saveField, path, overwrite});
}

void Painter::saveStrokes(const std::filesystem::path& path, bool overwrite)
{
    savings_.push_back({Asked::saveStrokes, path, overwrite});
}

void Painter::saveFieldNow(const std::filesystem::path& path, bool overwrite)
{
    strokes.finish();
    saveField(path, overwrite);
    const std::size_t told = told_.size();
    while (session_.failure().empty() && !isIdle()) {
        // What changes on the way is not shown any more.
        poll([](const std::filesystem::path&) {});
        std::this_thread::sleep_for(savePoll);
    }
    for (std::size_t i = told; i < told_.size(); ++i)
        if (told_[i].isError)
            fail(ErrorKind::io, "{}: not saved: {}", path.string(), told_[i].text);
    told_.resize(told);
    if (!session_.failure().empty())
        fail(ErrorKind::io, "{}: not saved: {}", path.string(), session_.failure());
}

void Painter::writeStrokes(const std::filesystem::path& path)
{
    strokes.finish();
    writeTextFile(path, strokeFileText(strokes.finished()), false);
    strokes.setSaved(strokes.finishedRevision());
    removeAutosave();
}

void Painter::writeAutosave()
{
    if (autosaving_.valid()) {
        if (autosaving_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        if (const std::string error = autosaving_.get(); !error.empty())
            told_.push_back({true, error, {}});
    }
    if (strokes.isGrowing() || autosavedRevision_ == strokes.finishedRevision())
        return;
    autosavedRevision_ = strokes.finishedRevision();
    if (!strokes.isUnsaved())
        return removeAutosave();
    autosaving_ = std::async(std::launch::async,
                             [path = autosave_, text = strokeFileText(strokes.finished())] {
                                 try {
                                     writeTextFile(path, text, true);
                                     return std::string();
                                 } catch (const Error& error) {
                                     return std::string(error.what());
                                 }
                             });
}

void Painter::finishAutosave()
{
    // The one under way, then one of what has changed since it began.
    for (int i = 0; i < 2; ++i) {
        if (autosaving_.valid())
            autosaving_.wait();
        writeAutosave();
    }
}

void Painter::removeAutosave()
{
    if (autosaving_.valid())
        autosaving_.wait();
    std::error_code ignored;
    std::filesystem::remove(autosave_, ignored);
}

std::filesystem::path Painter::savedField() const
{
    return fieldRevision_ == strokes.finishedRevision() ? field_ : std::filesystem::path();
}

std::optional<Painter::Told> Painter::takeTold()
{
    if (told_.empty())
        return std::nullopt;
    Told told = std::move(told_.front());
    told_.erase(told_.begin());
    return told;
}

} // namespace sward::view
