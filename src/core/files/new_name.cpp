#include "core/files/new_name.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace sward {
namespace {

void removeFile(const char* path)
{
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

} // namespace

int moveToNewName(const char* temporary, const char* path, const NamingCalls& calls)
{
    if (calls.link(temporary, path) == 0) {
        removeFile(temporary);
        return 0;
    }
    if (errno == EEXIST)
        return EEXIST;
    if (calls.moveToNew(temporary, path) == 0)
        return 0;
    if (errno == EEXIST)
        return EEXIST;
    if (calls.create(path) != 0)
        return errno;
    if (calls.moveOver(temporary, path) == 0)
        return 0;
    const int reason = errno;
    removeFile(path);
    return reason;
}

} // namespace sward
