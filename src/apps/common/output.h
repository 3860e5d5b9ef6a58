#pragma once

#include <string_view>

namespace sward::apps {

/// Writes a result to stdout. Throws Error{io} if stdout does not take it (a full disk).
void writeResult(std::string_view text);

} // namespace sward::apps
