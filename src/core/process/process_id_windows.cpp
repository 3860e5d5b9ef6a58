#include "core/system/native_windows.h"
#include "core/process/process_id.h"

namespace sward {

std::uint64_t processId() noexcept
{
    return ::GetCurrentProcessId();
}

} // namespace sward
