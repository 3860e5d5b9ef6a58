#include "core/system/native_windows.h"
#include "core/system/shared_library.h"

#include <filesystem>

namespace sward {

std::string libraryFile(const std::string& name, int version)
{
    return name + "-" + std::to_string(version) + ".dll";
}

void* functionOf(const char* library, const char* function)
{
    const std::filesystem::path file(library);
    const HMODULE opened = ::LoadLibraryW(file.c_str());
    return opened != nullptr ? reinterpret_cast<void*>(::GetProcAddress(opened, function))
                             : nullptr;
}

} // namespace sward
