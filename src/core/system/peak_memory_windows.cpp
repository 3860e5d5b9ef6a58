#include "core/system/native_windows.h"
#include "core/system/peak_memory.h"

#include <psapi.h>

namespace sward {

std::uint64_t peakMemory()
{
    PROCESS_MEMORY_COUNTERS counters = {};
    if (::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) == 0)
        return 0;
    return counters.PeakWorkingSetSize;
}

} // namespace sward
