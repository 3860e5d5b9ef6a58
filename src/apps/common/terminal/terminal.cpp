#include "apps/common/terminal/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

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
    return ::isatty(STDERR_FILENO) == 1 && environment("TERM") != "dumb";
}

bool stderrTakesColor()
{
    return stderrIsTerminal() && environment("NO_COLOR").empty();
}

int stderrColumns()
{
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return 80;
    return size.ws_col;
}

} // namespace sward::apps
