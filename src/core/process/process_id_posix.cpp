#include "core/process/process_id.h"

#include <unistd.h>

namespace sward {

std::uint64_t processId() noexcept
{
    return static_cast<std::uint64_t>(::getpid());
}

} // namespace sward
