#include "apps/common/terminal/progress_bar.h"

#include "apps/common/terminal/terminal.h"
#include "core/log.h"

#include <fmt/core.h>

#include <algorithm>

namespace sward::apps {
namespace {

constexpr int stageColumns = 12; ///< room for a stage's name
constexpr int otherColumns = 11; ///< blanks, brackets and the percentage

} // namespace

std::string progressLine(const std::string& stage, double share, int columns)
{
    const double clamped = std::clamp(share, 0.0, 1.0);
    const int cells = std::clamp(columns - stageColumns - otherColumns, 0, 50);
    const int full = static_cast<int>(clamped * cells + 0.5);
    const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                            std::string(static_cast<std::size_t>(cells - full), ' ');
    const std::string line = fmt::format("{:<{}.{}}  [{}] {:3.0f} %", stage, stageColumns,
                                         stageColumns, bar, 100.0 * clamped);
    return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

ProgressBar::ProgressBar(bool shown)
    : shown_(shown)
    , colored_(shown && stderrTakesColor())
{
}

ProgressBar::~ProgressBar()
{
    clear();
}

Progress::Callback ProgressBar::callback()
{
    if (!shown_)
        return {};
    return [this](const std::string& stage, double share) { show(stage, share); };
}

void ProgressBar::clear()
{
    if (shown_)
        log::setStatusLine("");
}

void ProgressBar::show(const std::string& stage, double share)
{
    const std::string line = progressLine(stage, share, stderrColumns());
    log::setStatusLine(colored_ ? "\033[32m" + line + "\033[0m" : line);
}

} // namespace sward::apps
