#include "core/files/new_name.h"

#include <fcntl.h>
#include <unistd.h>

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

} // namespace sward
