#include "core/system/freed_memory.h"

#include <malloc.h>

#include <limits>

namespace sward {

void keepFreedMemory()
{
    mallopt(M_MMAP_MAX, 0); // no mapping of its own for a large block
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TOP_PAD, 64 << 20);
}

} // namespace sward
