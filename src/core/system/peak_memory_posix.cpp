#include "core/system/peak_memory.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace sward {

std::uint64_t peakMemory()
{
    // Not getrusage(): its number begins with the memory of the program that started this one.
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::uint64_t kibibytes = 0;
        if (word == "VmHWM:" && status >> kibibytes)
            return kibibytes * 1024;
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    // Linux counts in units of 1024 bytes.
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace sward
