// The main of each fuzzer: SWARD_FUZZ_ENTRY is the function of fuzz/entries.h that it calls.

#include "fuzz/entries.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    sward::fuzz::SWARD_FUZZ_ENTRY({data, size});
    return 0;
}
