#include "apps/sward_view/paint/edit_session.h"

#include "apps/sward_view/files/sward_program.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/log.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <utility>

namespace sward::view {
namespace {

using nlohmann::json;

constexpr const char* editFormat = "sward edit 1";
constexpr std::size_t longestAnswer = std::size_t(16) << 20; ///< [bytes]
constexpr std::chrono::milliseconds endsByItself{50};        ///< an idle one, after its input
constexpr std::chrono::milliseconds endsIn{1000};            ///< a busy one, after it was asked to

std::string howItEnded(const ChildProcess::End& end)
{
    return end.exitCode ? fmt::format("it ended with exit code {}", *end.exitCode)
                        : fmt::format("it was ended by {}", end.reason);
}

template <typename T>
T valueOr(const json& from, const char* key, T otherwise)
{
    const auto found = from.find(key);
    if (found == from.end())
        return otherwise;
    if constexpr (std::is_same_v<T, std::string>)
        return found->is_string() ? found->get<T>() : otherwise;
    else if constexpr (std::is_same_v<T, bool>)
        return found->is_boolean() ? found->get<T>() : otherwise;
    else if constexpr (std::is_same_v<T, double>)
        return found->is_number() ? found->get<T>() : otherwise;
    else
        return found->is_number_unsigned() ? found->get<T>() : otherwise;
}

std::vector<std::string> textsIn(const json& from, const char* key)
{
    std::vector<std::string> texts;
    const auto found = from.find(key);
    if (found != from.end() && found->is_array())
        for (const json& one : *found)
            if (one.is_string())
                texts.push_back(one.get<std::string>());
    return texts;
}

std::vector<LostStroke> lostIn(const json& from)
{
    std::vector<LostStroke> strokes;
    const auto found = from.find("lost");
    if (found != from.end() && found->is_array())
        for (const json& one : *found)
            if (one.is_object())
                strokes.push_back({valueOr<std::uint64_t>(one, "stroke", 0),
                                   valueOr<std::uint64_t>(one, "points", 0),
                                   valueOr<std::uint64_t>(one, "lost", 0),
                                   valueOr(one, "share", 0.0)});
    return strokes;
}

std::vector<MovedStroke> movedIn(const json& from)
{
    std::vector<MovedStroke> strokes;
    const auto found = from.find("moved");
    if (found != from.end() && found->is_array())
        for (const json& one : *found)
            if (one.is_object() && one.contains("stroke"))
                strokes.push_back(
                    {valueOr<std::uint64_t>(one, "index", 0), jsonText(one["stroke"])});
    return strokes;
}

} // namespace

EditSession::EditSession(const std::vector<std::string>& command)
    : child_(std::make_unique<ChildProcess>(command, ChildTalk::answers))
{
}

EditSession::~EditSession()
{
    close();
}

// Ends its input, upon which it removes its files and ends; a busy one is asked to end.
void EditSession::close()
{
    if (!child_)
        return;
    child_->endInput();
    if (!child_->endWithin(endsByItself)) {
        child_->askToEnd();
        child_->endWithin(endsIn);
    }
    child_.reset();
}

void EditSession::end(std::string why)
{
    if (failure_.empty())
        failure_ = "sward edit: " + std::move(why);
    close();
}

std::uint64_t EditSession::ask(std::string_view keys)
{
    outgoing_ += fmt::format("{{\"id\":{},{}}}\n", ++lastId_, keys);
    writeOut();
    return lastId_;
}

void EditSession::writeOut()
{
    // What it does not take now, poll() offers again, and notices its end.
    if (child_)
        outgoing_.erase(0, child_->offer(outgoing_));
}

void EditSession::poll()
{
    if (!child_)
        return;
    writeOut();
    takeSaid(child_->said());
    const std::optional<std::string> answered = child_->answered();
    incoming_ += answered.value_or("");
    std::size_t from = 0;
    for (std::size_t end = 0; failure_.empty(); from = end + 1) {
        end = incoming_.find('\n', from);
        if (end == std::string::npos)
            break;
        takeLine(incoming_.substr(from, end - from));
    }
    incoming_.erase(0, from);
    if (!failure_.empty())
        return;
    if (incoming_.size() > longestAnswer)
        return end(fmt::format("its answer is longer than {} MiB", longestAnswer >> 20));
    if (answered)
        return;
    // Its end follows that of its output.
    const std::optional<ChildProcess::End> ended = child_->end();
    if (!ended)
        return;
    takeSaid(child_->said());
    end(howItEnded(*ended) + (lastSaid_.empty() ? "" : ": " + lastSaid_));
}

std::optional<EditAnswer> EditSession::take()
{
    if (taken_.empty())
        return std::nullopt;
    EditAnswer answer = std::move(taken_.front());
    taken_.pop_front();
    return answer;
}

void EditSession::takeLine(const std::string& line)
{
    if (ready_)
        return takeAnswer(line);
    const json first = json::parse(line, nullptr, false);
    if (!first.is_object() || valueOr<std::string>(first, "format", {}) != editFormat)
        return end(fmt::format("its first line is not that of \"{}\"", editFormat));
    EditReady ready;
    ready.blades = valueOr<std::uint64_t>(first, "blades", 0);
    ready.strokes = valueOr<std::uint64_t>(first, "strokes", 0);
    ready.species = textsIn(first, "species");
    ready.scale = valueOr(first, "scale", 1.0);
    ready.reused = valueOr(first, "reused", false);
    ready.lost = lostIn(first);
    ready.warnings = textsIn(first, "warnings");
    ready_ = std::move(ready);
}

void EditSession::takeAnswer(const std::string& line)
{
    const json read = json::parse(line, nullptr, false);
    EditAnswer answer;
    answer.id = read.is_object() ? valueOr<std::uint64_t>(read, "id", 0) : 0;
    if (answer.id != answered_ + 1 || answer.id > lastId_)
        return end("it said what is no answer to a request");
    answered_ = answer.id;
    if (read.contains("error"))
        answer.error = valueOr<std::string>(read, "message", "it gave no reason");
    answer.delta = valueOr<std::string>(read, "delta", {});
    answer.blades = valueOr<std::uint64_t>(read, "blades", 0);
    answer.total = valueOr<std::uint64_t>(read, "total", 0);
    answer.seconds = valueOr(read, "seconds", 0.0);
    answer.saved = valueOr<std::string>(read, "saved", {});
    answer.lost = lostIn(read);
    answer.moved = movedIn(read);
    answer.warnings = textsIn(read, "warnings");
    answer.species = valueOr<std::string>(read, "species", {});
    taken_.push_back(std::move(answer));
}

void EditSession::takeSaid(std::string_view text)
{
    for (const char c : text) {
        if (c != '\n' && c != '\r') {
            unfinished_ += c;
            continue;
        }
        const std::string line = plainLine(std::exchange(unfinished_, {}));
        if (line.empty())
            continue;
        if (const auto progress = parseProgress(line)) {
            progress_ = *progress;
            continue;
        }
        log::info("sward edit: {}", line);
        lastSaid_ = line.starts_with("error: ") ? line.substr(7) : line;
    }
    if (const auto progress = parseProgress(plainLine(unfinished_)))
        progress_ = *progress;
}

} // namespace sward::view
