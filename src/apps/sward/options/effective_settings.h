#pragma once

#include "apps/sward/options/bake_options.h"

#include <string>

namespace sward::apps {

/// All settings that determine the result of a bake, defaults included, as JSON for people and
/// programs.
std::string effectiveSettings(const BakeRequest& request);

} // namespace sward::apps
