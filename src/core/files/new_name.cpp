#include "core/files/new_name.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace sward {
namespace {

int moveWithoutReplacing(const char* from, const char* to)
{
    return ::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
}

int createNew(const char* path)
{
    const int fd = ::open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return fd < 0 ? -1 : ::close(fd);
}

int moveReplacing(const char* from, const char* to)
{
    return ::rename(from, to);
}

} // namespace

const NamingCalls systemCalls{::link, moveWithoutReplacing, createNew, moveReplacing};

int moveToNewName(const char* temporary, const char* path, const NamingCalls& calls)
{
    if (calls.link(temporary, path) == 0) {
        ::unlink(temporary);
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
    ::unlink(path);
    return reason;
}

} // namespace sward
