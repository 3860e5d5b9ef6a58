#include "core/system/native_windows.h"
#include "core/system/standard_streams.h"

#include <fcntl.h>
#include <io.h>

#include <cstdio>

namespace sward {

void prepareStandardStreams() noexcept
{
    // Otherwise each newline gets a carriage return.
    for (std::FILE* const stream : {stdin, stdout, stderr})
        ::_setmode(::_fileno(stream), _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
}

bool stderrIsConsole() noexcept
{
    const HANDLE out = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return ::GetConsoleMode(out, &mode) != 0 &&
           ::SetConsoleMode(out, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

int stderrConsoleColumns() noexcept
{
    CONSOLE_SCREEN_BUFFER_INFO screen = {};
    if (::GetConsoleScreenBufferInfo(::GetStdHandle(STD_ERROR_HANDLE), &screen) == 0)
        return 0;
    return screen.srWindow.Right - screen.srWindow.Left + 1;
}

} // namespace sward
