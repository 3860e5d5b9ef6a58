#include "core/log.h"

#include "core/plain_text.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>

namespace sward::log {
namespace {

spdlog::level::level_enum toSpdlog(Level level)
{
    switch (level) {
    case Level::debug:
        return spdlog::level::debug;
    case Level::info:
        return spdlog::level::info;
    case Level::warning:
        return spdlog::level::warn;
    case Level::error:
        return spdlog::level::err;
    }
    return spdlog::level::info;
}

// One logger for the process. It writes to stderr because results go to stdout.
spdlog::logger& logger()
{
    static const std::unique_ptr<spdlog::logger> instance = [] {
        auto made = std::make_unique<spdlog::logger>(
            "sward", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        made->set_pattern("%v");
        return made;
    }();
    return *instance;
}

// The status line, kept last on stderr. Writing to stderr requires the mutex.
struct StatusLine {
    std::mutex mutex;
    std::string text;

    void erase() const
    {
        if (!text.empty())
            std::fputs("\r\033[K", stderr);
    }

    void show() const
    {
        std::fputs(text.c_str(), stderr);
        std::fflush(stderr);
    }
};

StatusLine& statusLine()
{
    static StatusLine line;
    return line;
}

constexpr std::size_t longestWord = 400; // [bytes] longer ones are shortened
constexpr std::size_t shownStart = 160;
constexpr std::size_t shownEnd = 80;

bool isContinuation(char c)
{
    return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

// Appends text[begin, end), without its middle if it is long. Never cuts a UTF-8 character.
void appendWord(const std::string& text, std::size_t begin, std::size_t end, std::string& to)
{
    if (end - begin <= longestWord) {
        to.append(text, begin, end - begin);
        return;
    }
    std::size_t head = begin + shownStart;
    std::size_t tail = end - shownEnd;
    while (head > begin && isContinuation(text[head]))
        --head;
    while (tail < end && isContinuation(text[tail]))
        ++tail;
    to.append(text, begin, head - begin).append("…").append(text, tail, end - tail);
}

} // namespace

std::string printable(const std::string& text)
{
    const std::string plain = plainText(text);
    std::string result;
    for (std::size_t begin = 0; begin < plain.size();) {
        const std::size_t end = std::min(plain.find_first_of(" \n", begin), plain.size());
        appendWord(plain, begin, end, result);
        if (end < plain.size())
            result += plain[end];
        begin = end + 1;
    }
    return result;
}

void setStatusLine(const std::string& line)
{
    StatusLine& status = statusLine();
    const std::lock_guard lock(status.mutex);
    status.erase();
    status.text = line;
    status.show();
}

void setLevel(Level level)
{
    logger().set_level(toSpdlog(level));
}

void write(Level level, const std::string& text)
{
    if (!logger().should_log(toSpdlog(level)))
        return;
    StatusLine& status = statusLine();
    const std::lock_guard lock(status.mutex);
    status.erase();
    // Warnings and errors get a label; progress messages do not.
    const char* label = level == Level::error     ? "error: "
                        : level == Level::warning ? "warning: "
                                                  : "";
    logger().log(toSpdlog(level), "{}{}", label, printable(text));
    status.show();
}

} // namespace sward::log
