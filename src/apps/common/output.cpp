#include "apps/common/output.h"

#include "core/error.h"
#include "core/log.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace sward::apps {

void writeResult(std::string_view text)
{
    // Clear the status line: both streams may be the same terminal.
    log::setStatusLine("");
    const bool written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written)
        fail(ErrorKind::io, "standard output: cannot write: {}", std::strerror(errno));
}

} // namespace sward::apps
