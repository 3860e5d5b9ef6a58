#include "apps/common/terminal/terminal.h"

#include "core/system/standard_streams.h"

#include <cstdlib>
#include <string_view>

namespace sward::apps {
namespace {

std::string_view environment(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view() : std::string_view(value);
}

} // namespace

bool stderrIsTerminal()
{
    return stderrIsConsole() && environment("TERM") != "dumb";
}

bool stderrTakesColor()
{
    return stderrIsTerminal() && environment("NO_COLOR").empty();
}

int stderrColumns()
{
    const int columns = stderrConsoleColumns();
    return columns > 0 ? columns : 80;
}

} // namespace sward::apps
