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

} // namespace sward
