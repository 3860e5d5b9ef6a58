#include "core/error.h"
#include "core/process/arriving_bytes.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace sward {

std::optional<std::size_t> readArriving(int descriptor, std::span<char> bytes,
                                        std::chrono::milliseconds patience)
{
    // A signal that comes just before a read would not end it.
    pollfd waiting{descriptor, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(patience.count())) <= 0)
        return std::nullopt;
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR)
        return std::nullopt;
    if (got < 0)
        fail(ErrorKind::io, "standard input: cannot read: {}", std::strerror(errno));
    return static_cast<std::size_t>(got);
}

} // namespace sward
