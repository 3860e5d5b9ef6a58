#pragma once

#include <string>

namespace sward::apps {

/// "sward 0.1.0"
std::string versionText(const std::string& program);

} // namespace sward::apps
