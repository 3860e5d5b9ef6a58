#include "core/system/arguments.h"

namespace sward {

std::vector<std::string> programArguments(int argc, const char* const* argv)
{
    return {argv, argv + argc};
}

} // namespace sward
