#include "core/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

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

// One logger for the process, to stderr: results own stdout.
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

} // namespace

void setLevel(Level level)
{
    logger().set_level(toSpdlog(level));
}

void write(Level level, const std::string& text)
{
    // Warnings and errors say what they are; plain progress does not need a label.
    const char* label = level == Level::error     ? "error: "
                        : level == Level::warning ? "warning: "
                                                  : "";
    logger().log(toSpdlog(level), "{}{}", label, text);
}

} // namespace sward::log
