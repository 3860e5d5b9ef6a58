#include "apps/common/peak_memory.h"

#include <sys/resource.h>

namespace sward::apps {

std::uint64_t peakMemory()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    // Linux counts in units of 1024 bytes.
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace sward::apps
