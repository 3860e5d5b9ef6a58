#pragma once

#include "field/measure/distributions.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::apps {

/// Each distribution with its bounds and a line of '#' for each bar, for people.
std::string histogramText(const field::Distributions& distributions);

/// The same as JSON: for each quantity count, least, mean, largest and its bars.
nlohmann::ordered_json histogramJson(const field::Distributions& distributions);

} // namespace sward::apps
