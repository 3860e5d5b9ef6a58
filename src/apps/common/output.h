#pragma once

#include <string_view>

namespace sward::apps {

/// Writes a result to stdout. Throws Error{io} if writing fails (a full disk).
void writeResult(std::string_view text);

} // namespace sward::apps
