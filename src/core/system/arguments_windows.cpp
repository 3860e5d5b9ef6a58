#include "core/system/arguments.h"
#include "core/system/native_windows.h"

#include <shellapi.h>

namespace sward {

std::vector<std::string> programArguments(int argc, const char* const* argv)
{
    int count = 0;
    LPWSTR* const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    if (wide == nullptr)
        return {argv, argv + argc};
    std::vector<std::string> arguments;
    for (int i = 0; i < count; ++i)
        arguments.push_back(native::utf8Of(wide[i]));
    ::LocalFree(wide);
    return arguments;
}

} // namespace sward
