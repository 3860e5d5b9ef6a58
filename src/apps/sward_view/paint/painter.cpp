#include "apps/sward_view/paint/painter.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/json/json_text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>
#include <utility>

namespace sward::view {
namespace {

constexpr std::chrono::milliseconds savePoll{5};
constexpr double pixelsBeside = 2.0; ///< tolerance beside a blade that is looked for

// The list with the strokes that the session begins with.
const StrokeList& begun(StrokeList& list, const std::vector<std::string>& strokes)
{
    list.reset(strokes, true);
    return list;
}

} // namespace

Painter::Painter(std::vector<std::string> command, const std::vector<std::string>& held,
                 Autosave autosave, std::unique_ptr<apps::TemporaryFolder> folder)
    : folder_(std::move(folder))
    , session_(std::move(command))
    , autosave_(std::move(autosave), begun(strokes, held))
    , held_(held)
    , heldRevision_(strokes.revision())
{
}

Painter::~Painter()
{
    finishAutosave();
}

std::filesystem::path Painter::finishAutosave()
{
    strokes.finish();
    return autosave_.finish(strokes);
}

void Painter::poll(const std::function<void(const std::filesystem::path&)>& apply)
{
    const bool hadReady = session_.isReady();
    const bool hadFailed = !session_.failure().empty();
    session_.poll();
    if (!hadReady && session_.isReady()) {
        total_ = session_.ready().blades;
        takeLost(session_.ready().lost, 0);
    }
    while (const auto answer = session_.take())
        takeAnswer(*answer, apply);
    if (!hadFailed && !session_.failure().empty())
        told_.push_back({true, session_.failure(), {}});
    autosave_.follow(strokes);
    // Without a session the painting ends, and the autosave has what remains of it.
    if (!session_.failure().empty())
        autosave_.finish(strokes);
    if (std::string trouble = autosave_.takeTrouble(); !trouble.empty())
        told_.push_back({true, std::move(trouble), {}});
    if (isReady() && under_ == Asked::nothing)
        askNext();
}

bool Painter::isIdle() const
{
    return under_ == Asked::nothing && look_.empty() && !mustClear_ && savings_.empty() &&
           !autosave_.isWriting() && !moveBy_ && heldRevision_ == strokes.revision();
}

void Painter::takeAnswer(const EditAnswer& answer,
                         const std::function<void(const std::filesystem::path&)>& apply)
{
    const Asked what = std::exchange(under_, Asked::nothing);
    if (!answer.error.empty())
        told_.push_back({true, answer.error, {}});
    if (what == Asked::paint || what == Asked::move) {
        // A state that is refused is not asked for again; the next one is.
        heldRevision_ = askedRevision_;
        if (!answer.error.empty())
            return;
        if (what == Asked::paint)
            held_ = std::move(asked_);
        else
            takeMoved(answer);
        takeLost(answer.lost, what == Asked::paint ? askedKeep_ : 0);
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
    if (what == Asked::species) {
        if (answer.error.empty())
            told_.push_back(
                {false,
                 answer.species.empty() ? "No blade here" : "The brush sows " + answer.species,
                 {},
                 answer.species});
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
            autosave_.discard(strokes);
    }
}

void Painter::takeLost(const std::vector<LostStroke>& lost, std::size_t first)
{
    lost_.take(held_, lost, first);
    // In words once, of strokes that came from a file; the list marks those that are drawn.
    const std::size_t count = lost_.countIn(strokes);
    if (std::exchange(hasToldLost_, !held_.empty()) || strokes.isGrowing() || count == 0)
        return;
    told_.push_back({true,
                     fmt::format("{} of {} strokes touch no ground, or in a part only. The panel "
                                 "Paint marks them; 'Move onto ground' moves them.",
                                 count, strokes.entries().size()),
                     {}});
}

// The session has moved strokes; so does the list, in which the user may have changed others.
void Painter::takeMoved(const EditAnswer& answer)
{
    std::map<std::string, std::string> after;
    for (const MovedStroke& one : answer.moved)
        if (one.stroke < held_.size())
            after[std::exchange(held_[one.stroke], one.text)] = one.text;
    std::vector<StrokeList::Replacement> replaced;
    for (std::size_t i = 0; i < strokes.entries().size(); ++i) {
        const StrokeList::Entry& entry = strokes.entries()[i];
        if (const auto found = after.find(entry.text); entry.visible && found != after.end())
            replaced.push_back({i, found->second});
    }
    strokes.replace(replaced);
    heldRevision_ = strokes.visible() == held_ ? strokes.revision() : 0;
    told_.push_back({false,
                     fmt::format("{} stroke{} moved onto the ground", replaced.size(),
                                 replaced.size() == 1 ? "" : "s"),
                     {}});
}

void Painter::lookForSpecies(const Sight& sight, double farthest)
{
    const glm::dvec3& eye = sight.eye;
    const glm::dvec3& way = sight.direction;
    look_ = fmt::format("\"do\":\"species\",\"eye\":[{},{},{}],\"direction\":[{},{},{}],"
                        "\"distance\":{},\"spread\":{}",
                        eye.x, eye.y, eye.z, way.x, way.y, way.z, farthest,
                        std::min(pixelsBeside * sight.pixelSize, 1.0));
}

void Painter::askNext()
{
    if (mustClear_) {
        mustClear_ = false;
        // The state after it differs from what is held, so that all strokes follow.
        askPaint({}, 0);
    } else if (strokes.revision() != heldRevision_) {
        askPaint(strokes.visible(), strokes.revision());
    } else if (!look_.empty()) {
        under_ = Asked::species;
        session_.ask(std::exchange(look_, {}));
    } else if (moveBy_ && !strokes.isGrowing()) {
        under_ = Asked::move;
        askedRevision_ = strokes.revision();
        session_.ask(
            fmt::format("\"do\":\"move\",\"distance\":{}", *std::exchange(moveBy_, std::nullopt)));
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
    askedKeep_ = keep;
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
    autosave_.discard(strokes);
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
