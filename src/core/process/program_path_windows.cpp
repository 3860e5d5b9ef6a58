#include "core/process/program_path.h"
#include "core/system/native_windows.h"

#include <sstream>
#include <system_error>
#include <vector>

namespace sward {

std::filesystem::path programPath()
{
    // The longest path that Windows knows, with its end.
    std::vector<wchar_t> path(1 << 15);
    const DWORD size = ::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    return std::filesystem::path(path.data(), path.data() + size);
}

std::filesystem::path ownFolder()
{
    return programPath().parent_path();
}

std::filesystem::path programFile(const std::filesystem::path& name)
{
    return std::filesystem::path(name) += ".exe";
}

std::filesystem::path programNamed(const std::string& name)
{
    std::wistringstream folders(native::environmentOf(L"PATH"));
    for (std::wstring folder; std::getline(folders, folder, L';');) {
        // A folder whose name holds a semicolon stands in quotation marks; those are not split
        // here.
        std::erase(folder, L'"');
        if (std::filesystem::path program = std::filesystem::path(folder) / programFile(name);
            !folder.empty() && isProgram(program))
            return program;
    }
    return {};
}

bool isProgram(const std::filesystem::path& file)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored);
}

} // namespace sward
