#include "core/files/new_name.h"
#include "core/system/native_windows.h"

#include <cerrno>
#include <filesystem>

namespace sward {
namespace {

// 0 if a call of Windows has succeeded, else -1 with errno.
int resultOf(bool succeeded)
{
    if (!succeeded)
        errno = native::errnoOf(::GetLastError());
    return succeeded ? 0 : -1;
}

// A second name would need rights that a rename does not.
int link(const char*, const char*)
{
    errno = ENOSYS;
    return -1;
}

int moveWithoutReplacing(const char* from, const char* to)
{
    return resultOf(::MoveFileExW(std::filesystem::path(from).c_str(),
                                  std::filesystem::path(to).c_str(), MOVEFILE_WRITE_THROUGH) != 0);
}

int createNew(const char* path)
{
    const native::Handle file(::CreateFileW(std::filesystem::path(path).c_str(), GENERIC_WRITE, 0,
                                            nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
    return resultOf(file.isOpen());
}

int moveReplacing(const char* from, const char* to)
{
    const std::filesystem::path target(to);
    return resultOf(::MoveFileExW(std::filesystem::path(from).c_str(), target.c_str(),
                                  MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0);
}

} // namespace

const NamingCalls systemCalls{link, moveWithoutReplacing, createNew, moveReplacing};

} // namespace sward
