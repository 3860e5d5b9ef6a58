#pragma once

#include <string>

namespace sward::apps {

/// Formats the provenance of a field (a JSON object) as tables: program, input, settings of the
/// bake, species side by side. Missing limits read "unlimited", missing values "none". Returns any
/// other text as one line.
std::string provenanceText(const std::string& provenance);

} // namespace sward::apps
