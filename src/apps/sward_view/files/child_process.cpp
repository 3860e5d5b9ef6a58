#include "apps/sward_view/files/child_process.h"

#include "core/error.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

namespace sward::view {

namespace {

// `output`: its stdout.
pid_t spawn(std::vector<std::string> arguments, int output, int said, std::optional<int> input)
{
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    if (input)
        ::posix_spawn_file_actions_adddup2(&actions, *input, STDIN_FILENO);
    // Redirect its stdout, because stdout carries this program's result.
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, said, STDERR_FILENO);
    pid_t child = -1;
    const int error =
        ::posix_spawn(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], std::strerror(error));
    return child;
}

} // namespace

std::filesystem::path programNamed(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        std::error_code error;
        if (std::filesystem::is_regular_file(program, error) &&
            ::access(program.c_str(), X_OK) == 0)
            return program;
    }
    return {};
}

pid_t startChild(std::vector<std::string> arguments, int said, std::optional<int> input)
{
    return spawn(std::move(arguments), said, said, input);
}

pid_t startTalkingChild(std::vector<std::string> arguments, int input, int output, int said)
{
    return spawn(std::move(arguments), output, said, input);
}

ChildEnd runChild(std::vector<std::string> arguments)
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        fail(ErrorKind::runtime, "cannot make a pipe: {}", std::strerror(errno));
    ChildEnd end;
    pid_t child = -1;
    try {
        child = spawn(std::move(arguments), ends[1], ends[1], std::nullopt);
    } catch (...) {
        ::close(ends[0]);
        ::close(ends[1]);
        throw;
    }
    ::close(ends[1]);
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
        if (count > 0)
            end.said.append(buffer.data(), static_cast<std::size_t>(count));
        else if (count == 0 || errno != EINTR)
            break;
    }
    ::close(ends[0]);
    while (::waitpid(child, &end.status, 0) < 0 && errno == EINTR)
        continue;
    return end;
}

} // namespace sward::view
