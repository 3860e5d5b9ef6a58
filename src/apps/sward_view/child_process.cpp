#include "apps/sward_view/child_process.h"

#include "core/error.h"

#include <spawn.h>
#include <unistd.h>

#include <cstring>

namespace sward::view {

pid_t startChild(std::vector<std::string> arguments, int said, std::optional<int> input)
{
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    if (input)
        ::posix_spawn_file_actions_adddup2(&actions, *input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, said, STDERR_FILENO);
    pid_t child = -1;
    const int error =
        ::posix_spawn(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], std::strerror(error));
    return child;
}

} // namespace sward::view
