#include "core/system/shared_library.h"

#include <dlfcn.h>

namespace sward {

std::string libraryFile(const std::string& name, int version)
{
    return "lib" + name + ".so." + std::to_string(version);
}

void* functionOf(const char* library, const char* function)
{
    void* const opened = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    return opened != nullptr ? dlsym(opened, function) : nullptr;
}

std::filesystem::path ownFolder()
{
    Dl_info info = {};
    std::error_code ignored;
    // Of a program the linker knows the name by which it was called.
    std::filesystem::path file;
    if (dladdr(reinterpret_cast<const void*>(&functionOf), &info) != 0 && info.dli_fname != nullptr)
        file = info.dli_fname;
    if (file.filename().string().find(".so") == std::string::npos)
        file = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return std::filesystem::weakly_canonical(file, ignored).parent_path();
}

} // namespace sward
