#include "core/process/program_path.h"

#include <unistd.h>

#include <system_error>

namespace sward {

std::filesystem::path programPath()
{
    std::error_code ignored;
    return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

std::filesystem::path programFile(const std::filesystem::path& name)
{
    return name;
}

bool isProgram(const std::filesystem::path& file)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

} // namespace sward
