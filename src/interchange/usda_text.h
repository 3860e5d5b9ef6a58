#pragma once

#include <string>
#include <string_view>

namespace sward::interchange {

/// `text` in quotation marks as a USD layer has strings: what would end or break it is escaped.
std::string usdString(std::string_view text);

/// `name` with an underscore in place of what an identifier of USD may not have.
std::string usdIdentifier(std::string_view name);

} // namespace sward::interchange
