#include "apps/sward_view/paint/edit_session.h"

#include "apps/sward_view/files/child_process.h"
#include "apps/sward_view/files/sward_program.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace sward::view {
namespace {

using nlohmann::json;

constexpr const char* editFormat = "sward edit 1";
constexpr std::size_t longestAnswer = std::size_t(16) << 20; ///< [bytes]
constexpr std::chrono::milliseconds endsIn{1000};            ///< after its input has ended
constexpr std::chrono::milliseconds endPoll{5};
constexpr int readsPerPoll = 64; ///< of 64 KiB

// A pair of ends that close on exec: [0] stays here, [1] becomes the child's.
struct Ends {
    Ends()
    {
        // A socket: writing to one whose reader has died can avoid SIGPIPE.
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, own.data()) != 0)
            fail(ErrorKind::runtime, "cannot make a socket: {}", std::strerror(errno));
        ::fcntl(own[0], F_SETFL, O_NONBLOCK);
    }
    Ends(const Ends&) = delete;
    Ends& operator=(const Ends&) = delete;
    ~Ends()
    {
        for (const int end : own)
            if (end >= 0)
                ::close(end);
    }
    int keep() { return std::exchange(own[0], -1); }

    std::array<int, 2> own{-1, -1};
};

// Reads all bytes that have arrived, up to a bound. Returns whether the other end is still open.
template <typename Take>
bool readAll(int from, const Take& take)
{
    std::array<char, 65536> buffer;
    for (int i = 0; i < readsPerPoll; ++i) {
        const ssize_t count = ::read(from, buffer.data(), buffer.size());
        if (count > 0)
            take(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
        else if (count == 0)
            return false;
        else if (errno != EINTR)
            return errno == EAGAIN || errno == EWOULDBLOCK;
    }
    return true;
}

std::string howItEnded(int status)
{
    if (WIFSIGNALED(status))
        return fmt::format("it was ended by signal {} ({})", WTERMSIG(status),
                           ::strsignal(WTERMSIG(status)));
    return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
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

EditSession::EditSession(std::vector<std::string> command)
{
    Ends asks;
    Ends answers;
    Ends said;
    child_ = startTalkingChild(std::move(command), asks.own[1], answers.own[1], said.own[1]);
    asks_ = asks.keep();
    answers_ = answers.keep();
    said_ = said.keep();
}

EditSession::~EditSession()
{
    close();
}

// Ends its input, upon which it removes its files and ends; a busy one is ended by a signal.
void EditSession::close()
{
    if (asks_ >= 0)
        ::close(std::exchange(asks_, -1));
    if (child_ > 0) {
        ::kill(child_, SIGTERM);
        const auto until = std::chrono::steady_clock::now() + endsIn;
        int status = 0;
        while (::waitpid(child_, &status, WNOHANG) == 0) {
            if (std::chrono::steady_clock::now() >= until) {
                ::kill(child_, SIGKILL);
                while (::waitpid(child_, &status, 0) < 0 && errno == EINTR)
                    continue;
                break;
            }
            std::this_thread::sleep_for(endPoll);
        }
        child_ = -1;
    }
    for (int* const end : {&answers_, &said_})
        if (*end >= 0)
            ::close(std::exchange(*end, -1));
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
    while (asks_ >= 0 && !outgoing_.empty()) {
        const ssize_t count = ::send(asks_, outgoing_.data(), outgoing_.size(), MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return; // poll() tries again, and notices its end
        outgoing_.erase(0, static_cast<std::size_t>(count));
    }
}

void EditSession::poll()
{
    if (child_ <= 0)
        return;
    writeOut();
    readAll(said_, [this](std::string_view text) { takeSaid(text); });
    const bool isOpen = readAll(answers_, [this](std::string_view text) { incoming_ += text; });
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
    if (isOpen)
        return;
    // Its end follows that of its output.
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) != child_)
        return;
    readAll(said_, [this](std::string_view text) { takeSaid(text); });
    child_ = -1;
    end(howItEnded(status) + (lastSaid_.empty() ? "" : ": " + lastSaid_));
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
