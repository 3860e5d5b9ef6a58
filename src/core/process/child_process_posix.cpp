#include "core/error.h"
#include "core/process/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace sward {

struct ChildProcess::Handles {
    pid_t child = -1;
    int output = -1; ///< of its stdout and stderr
    std::optional<End> end;

    ~Handles()
    {
        if (child > 0 && !end) {
            ::kill(child, SIGKILL);
            int status = 0;
            while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
                continue;
        }
        if (output >= 0)
            ::close(output);
    }
};

ChildProcess::ChildProcess(const std::vector<std::string>& arguments)
    : handles_(std::make_unique<Handles>())
{
    std::vector<std::string> copies = arguments;
    std::vector<char*> pointers;
    for (std::string& argument : copies)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", std::strerror(errno));
    handles_->output = ends[0];
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    // Its stdout too, because that of this program carries this program's result.
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    const int error = ::posix_spawn(&handles_->child, pointers[0], &actions, nullptr,
                                    pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (error != 0) {
        handles_->child = -1;
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], std::strerror(error));
    }
}

ChildProcess::~ChildProcess() = default;

std::string ChildProcess::said()
{
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t count = ::read(handles_->output, buffer.data(), buffer.size());
        if (count <= 0)
            return text;
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

std::optional<ChildProcess::End> ChildProcess::end()
{
    int status = 0;
    if (!handles_->end && ::waitpid(handles_->child, &status, WNOHANG) == handles_->child) {
        handles_->end.emplace();
        if (WIFEXITED(status))
            handles_->end->exitCode = WEXITSTATUS(status);
        else if (WIFSIGNALED(status))
            handles_->end->reason = "signal " + std::to_string(WTERMSIG(status)) + " (" +
                                    ::strsignal(WTERMSIG(status)) + ")";
    }
    return handles_->end;
}

void ChildProcess::askToEnd()
{
    if (!handles_->end)
        ::kill(handles_->child, SIGTERM);
}

} // namespace sward
