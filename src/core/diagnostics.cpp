#include "core/diagnostics.h"

#include <algorithm>

namespace sward {

void Diagnostics::add(std::string text)
{
    if (warnings_.size() > warningLimit)
        return;
    if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end())
        return;
    if (warnings_.size() == warningLimit)
        text = "further warnings are left out";
    warnings_.push_back(std::move(text));
}

} // namespace sward
