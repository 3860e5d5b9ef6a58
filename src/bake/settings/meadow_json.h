#pragma once

#include "bake/settings/meadow.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::bake {

/// The meadow as a JSON value. Names of images keep their bytes, also where these are not UTF-8.
/// Include from .cpp files only.
nlohmann::json meadowToJson(const Meadow& meadow);

/// The inverse. Throws Error{input} naming `place`.
Meadow meadowFromJson(const nlohmann::json& object, const std::string& place);

/// Throws Error{input} naming `place` if two species of a meadow that meadowFromJson() reads are
/// given one name. Meadows of earlier fields may have such.
void requireOwnNames(const nlohmann::json& meadow, const std::string& place);

} // namespace sward::bake
