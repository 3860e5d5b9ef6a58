#pragma once

#include "bake/settings/settings.h"

#include <string>

namespace sward::bake {

/// The settings with which a field was baked, from its provenance. What that holds as a hash alone
/// stays as in `given`: masks with images, a meadow that has some, excluded areas, strokes; limits
/// too. Throws Error{input} that names `place` and the option that gives what is missing.
BakeSettings bakedSettings(const std::string& provenance, const BakeSettings& given,
                           const std::string& place);

} // namespace sward::bake
