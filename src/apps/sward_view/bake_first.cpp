#include "apps/sward_view/bake_first.h"

#include "core/error.h"
#include "core/log.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

/// A folder that goes when this object goes, with all that is in it.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (fs::temp_directory_path() / "sward-view.XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            fail(ErrorKind::io, "{}: cannot make a folder: {}", name, std::strerror(errno));
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

// The program `sward` beside this one: in a build folder, in a bundle and when installed.
fs::path swardProgram()
{
    std::error_code error;
    const fs::path own = fs::read_symlink("/proc/self/exe", error);
    const fs::path program = own.parent_path() / "sward";
    if (error || ::access(program.c_str(), X_OK) != 0)
        fail(ErrorKind::io, "{}: not found; it bakes a mesh before it is shown", program.string());
    return program;
}

// The errors that `sward` itself knows keep their exit code.
ErrorKind kindOf(int status)
{
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM ? ErrorKind::interrupted
                                                                         : ErrorKind::runtime;
    constexpr std::array known{ErrorKind::usage, ErrorKind::io, ErrorKind::input,
                               ErrorKind::unsupported, ErrorKind::interrupted};
    const auto* const found = std::find_if(known.begin(), known.end(), [status](ErrorKind kind) {
        return static_cast<int>(kind) == WEXITSTATUS(status);
    });
    return found == known.end() ? ErrorKind::runtime : *found;
}

// Runs a program to its end; its stderr is ours.
int runProgram(std::vector<std::string> arguments)
{
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t child = 0;
    const int error =
        ::posix_spawn(&child, pointers[0], nullptr, nullptr, pointers.data(), environ);
    if (error != 0)
        fail(ErrorKind::runtime, "{}: cannot be run: {}", arguments[0], std::strerror(error));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            fail(ErrorKind::runtime, "{}: cannot be waited for: {}", arguments[0],
                 std::strerror(errno));
    return status;
}

} // namespace

bool wantsBaking(const std::string& input)
{
    constexpr std::array<std::string_view, 9> extensions{".glb", ".gltf", ".obj", ".ply", ".stl",
                                                         ".off", ".png",  ".r16", ".json"};
    constexpr std::array<std::string_view, 6> builtIns{"plane", "sphere", "hills",
                                                       "dunes", "torus",  "arch"};
    std::string extension = fs::path(input).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
        return true;
    return !fs::exists(input) &&
           std::find(builtIns.begin(), builtIns.end(), input) != builtIns.end();
}

field::MappedField bakeFirst(const std::string& input)
{
    const fs::path program = swardProgram();
    const TemporaryFolder folder;
    const fs::path output = folder.path() / "field.sward";
    log::info("{}: is not a field; growing grass on it first", input);
    const int status = runProgram({program.string(), "bake", input, "-o", output.string()});
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail(kindOf(status), "{}: no grass could be grown on it, see above", input);

    // The mapping outlives the file's name.
    return field::readField(output);
}

} // namespace sward::view
