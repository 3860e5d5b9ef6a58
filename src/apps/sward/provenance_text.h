#pragma once

#include <string>

namespace sward::apps {

/// The provenance of a field, JSON of an object, as tables for people: program, input, the settings
/// of the bake, its species side by side. What has no limit is "unlimited", what is not set "none".
/// Any other text is returned as one line.
std::string provenanceText(const std::string& provenance);

} // namespace sward::apps
