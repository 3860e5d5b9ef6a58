#include "virtual_display.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace sward::test {

VirtualDisplay::VirtualDisplay()
{
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0)
        throw std::runtime_error("no pipe to Xvfb");

    // The server picks a free number and writes it to the pipe when it is ready.
    const std::string writeEnd = std::to_string(pipe[1]);
    server_ = fork();
    if (server_ == 0) {
        close(pipe[0]);
        const int null = open("/dev/null", O_WRONLY);
        dup2(null, STDERR_FILENO);
        execlp("Xvfb", "Xvfb", "-displayfd", writeEnd.c_str(), "-screen", "0", "800x600x24",
               "-nolisten", "tcp", nullptr);
        _exit(127);
    }
    close(pipe[1]);
    std::string number;
    for (char digit = 0; read(pipe[0], &digit, 1) == 1 && digit != '\n';)
        number += digit;
    close(pipe[0]);
    if (number.empty())
        throw std::runtime_error("Xvfb did not start; Debian's package is xvfb");
    name_ = ":" + number;
}

VirtualDisplay::~VirtualDisplay()
{
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

} // namespace sward::test
