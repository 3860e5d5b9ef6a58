#include "core/system/standard_streams.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace sward {

void prepareStandardStreams() noexcept
{
    // They do.
}

bool stderrIsConsole() noexcept
{
    return ::isatty(STDERR_FILENO) == 1;
}

int stderrConsoleColumns() noexcept
{
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

} // namespace sward
