#include "core/system/freed_memory.h"

namespace sward {

void keepFreedMemory() {}

} // namespace sward
