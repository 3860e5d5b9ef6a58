#include "core/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

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

} // namespace

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
    logger().log(toSpdlog(level), "{}{}", label, text);
    status.show();
}

} // namespace sward::log
