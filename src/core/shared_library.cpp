#include "core/shared_library.h"

#include <dlfcn.h>

namespace sward {

void* functionOf(const char* library, const char* function)
{
    void* const opened = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    return opened != nullptr ? dlsym(opened, function) : nullptr;
}

} // namespace sward
