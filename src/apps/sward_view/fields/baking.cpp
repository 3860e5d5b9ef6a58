#include "apps/sward_view/fields/baking.h"

#include "apps/common/field_input.h"
#include "apps/sward_view/files/sward_program.h"
#include "core/error.h"
#include "core/log.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace sward::view {
namespace {

constexpr std::size_t linesKept = 40; ///< of its output
constexpr int runtimeCode = static_cast<int>(ErrorKind::runtime);

} // namespace

bool wantsBaking(const std::string& input)
{
    return apps::namesGround(input);
}

std::optional<BakeProgress> parseProgress(std::string_view line)
{
    const std::size_t open = line.find("  [");
    const std::size_t close = line.rfind("] ");
    const std::size_t percent = line.rfind(" %");
    if (open == std::string_view::npos || close == std::string_view::npos ||
        percent == std::string_view::npos || close < open || percent < close)
        return std::nullopt;
    BakeProgress progress;
    progress.state = line.substr(0, open);
    progress.state.erase(progress.state.find_last_not_of(' ') + 1);
    progress.share = std::atof(std::string(line.substr(close + 2, percent - close - 2)).c_str());
    progress.share = std::clamp(progress.share / 100.0, 0.0, 1.0);
    return progress;
}

Baking::Baking(std::vector<std::string> arguments, std::filesystem::path output)
    : field_(output.empty() ? folder_.path() / "field.sward" : output)
{
    std::vector<std::string> all{swardProgram("it bakes a mesh before it is shown").string(),
                                 "bake"};
    if (!output.empty())
        all.emplace_back("--force");
    all.insert(all.end(), arguments.begin(), arguments.end());
    for (const std::string& argument :
         {std::string("-o"), field().string(), std::string("--report"), report().string(),
          std::string("--progress"), std::string("always")})
        all.push_back(argument);
    child_ = std::make_unique<ChildProcess>(all);
}

bool Baking::poll()
{
    if (end_)
        return true;
    // In this order: what it says at last is read after its end.
    const std::optional<ChildProcess::End> end = child_->end();
    takeIn(child_->said());
    if (!end)
        return false;
    takeIn("\n");
    end_ = end;
    return true;
}

void Baking::cancel()
{
    if (!end_) {
        cancelled_ = true;
        child_->askToEnd();
    }
}

void Baking::takeIn(std::string_view text)
{
    for (const char c : text) {
        if (c != '\n' && c != '\r') {
            unfinished_ += c;
            continue;
        }
        takeLine(plainLine(unfinished_));
        unfinished_.clear();
    }
    // The next bar ends the line of a bar; show the current one now.
    if (const auto progress = parseProgress(plainLine(unfinished_)))
        progress_ = *progress;
}

void Baking::takeLine(std::string line)
{
    if (line.empty())
        return;
    if (const auto progress = parseProgress(line)) {
        progress_ = *progress;
        return;
    }
    log::info("sward: {}", line);
    lines_.push_back(std::move(line));
    if (lines_.size() > linesKept)
        lines_.erase(lines_.begin());
}

bool Baking::succeeded() const
{
    return end_ && end_->exitCode == 0;
}

int Baking::exitCode() const
{
    return end_ ? end_->exitCode.value_or(runtimeCode) : runtimeCode;
}

ErrorKind Baking::errorKind() const
{
    if (cancelled_)
        return ErrorKind::interrupted;
    constexpr std::array known{ErrorKind::usage, ErrorKind::io, ErrorKind::input,
                               ErrorKind::unsupported, ErrorKind::interrupted};
    const auto* const found = std::find_if(known.begin(), known.end(), [this](ErrorKind kind) {
        return static_cast<int>(kind) == exitCode();
    });
    return found == known.end() ? ErrorKind::runtime : *found;
}

std::string Baking::complaint() const
{
    if (cancelled_)
        return "the bake was cancelled";
    if (end_ && !end_->exitCode)
        return "the bake was ended by " + end_->reason;
    for (auto line = lines_.rbegin(); line != lines_.rend(); ++line)
        if (line->starts_with("error: "))
            return line->substr(7);
    return lines_.empty() ? "the bake gave no reason" : lines_.back();
}

} // namespace sward::view
