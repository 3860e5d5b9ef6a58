// The main of each fuzzer: SWARD_FUZZ_ENTRY is the function of fuzz/entries.h that it calls.

#include "fuzz/entries.h"
#include "fuzz/memory_law.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace sward::fuzz;
    const MemoryPeak peak;
    SWARD_FUZZ_ENTRY({data, size});
    // What unpacks has bounds of its own.
    for (const Entry& entry : entries)
        if (entry.call == SWARD_FUZZ_ENTRY && entry.followsData &&
            peak.bytes() > memoryLimit(size)) {
            std::fprintf(stderr, "%zu bytes of memory for %zu bytes\n", peak.bytes(), size);
            std::abort();
        }
    return 0;
}
