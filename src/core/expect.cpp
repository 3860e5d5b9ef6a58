#include "core/expect.h"

#include <cstdio>
#include <cstdlib>

namespace sward {

void expectationFailed(const char* message, std::source_location where)
{
    std::fprintf(stderr, "%s:%u: %s: expected: %s\n", where.file_name(),
                 static_cast<unsigned>(where.line()), where.function_name(), message);
    std::abort();
}

} // namespace sward
