#pragma once

#include "field/field.h"

#include <string>
#include <string_view>
#include <vector>

namespace sward::field {

// The parts of a field stored as JSON text: small, and also read by people. Reading is strict and
// throws Error{input} naming `place`.

std::string speciesText(const std::vector<Species>& species);
std::vector<Species> parseSpecies(std::string_view text, const std::string& place);

/// The amount of grass; empty where the blades are the whole meadow.
std::string coverText(double thinned);
double parseCover(std::string_view text, const std::string& place);

std::string defaultsText(const Defaults& defaults, const std::string& copyright);
Defaults parseDefaults(std::string_view text, const std::string& place, std::string& copyright);

} // namespace sward::field
