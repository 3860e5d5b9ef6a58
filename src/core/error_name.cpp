#include "core/error_name.h"

namespace sward {

const char* nameOf(ErrorKind kind)
{
    switch (kind) {
    case ErrorKind::usage:
        return "usage";
    case ErrorKind::io:
        return "io";
    case ErrorKind::input:
        return "input";
    case ErrorKind::unsupported:
        return "unsupported";
    case ErrorKind::difference:
        return "difference";
    case ErrorKind::interrupted:
        return "interrupted";
    case ErrorKind::runtime:
        break;
    }
    return "runtime";
}

} // namespace sward
