#include "core/error.h"

#include "core/plain_text.h"

namespace sward {

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(plainText(message))
    , kind_(kind)
{
}

} // namespace sward
