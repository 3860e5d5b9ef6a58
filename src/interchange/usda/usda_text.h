#pragma once

#include <string>
#include <string_view>

namespace sward::interchange {

/// `text` as a quoted USD string, with escapes.
std::string usdString(std::string_view text);

/// `name` with invalid characters of a USD identifier replaced by underscores.
std::string usdIdentifier(std::string_view name);

} // namespace sward::interchange
