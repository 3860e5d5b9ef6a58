#include "core/diagnostics.h"

#include <algorithm>

namespace sward {

void Diagnostics::add(std::string text)
{
    if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end())
        warnings_.push_back(std::move(text));
}

} // namespace sward
