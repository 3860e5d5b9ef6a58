#include "core/process/program_path.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

namespace sward {

std::filesystem::path programPath()
{
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

std::filesystem::path ownFolder()
{
    Dl_info info = {};
    std::filesystem::path file;
    if (dladdr(reinterpret_cast<const void*>(&ownFolder), &info) != 0 && info.dli_fname != nullptr)
        file = info.dli_fname;
    // Of a program the linker knows the name by which it was called.
    if (file.filename().string().find(".so") == std::string::npos)
        file = programPath();
    std::error_code ignored;
    return std::filesystem::weakly_canonical(file, ignored).parent_path();
}

std::filesystem::path programFile(const std::filesystem::path& name)
{
    return name;
}

std::filesystem::path programNamed(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (std::filesystem::path program = std::filesystem::path(folder) / name;
            isProgram(program))
            return program;
    return {};
}

bool isProgram(const std::filesystem::path& file)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

} // namespace sward
