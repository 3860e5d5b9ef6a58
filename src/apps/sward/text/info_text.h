#pragma once

#include "field/field.h"
#include "field/measure/distributions.h"

#include <cstdint>
#include <string>

namespace sward::apps {

/// Describes a field file of `fileBytes` as readable text; with `distributions` if given.
std::string infoText(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes, const field::Distributions* distributions = nullptr);

/// The same as JSON: lengths in metres, bounds in world space; distributions under "histogram".
std::string infoJson(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes, const field::Distributions* distributions = nullptr);

} // namespace sward::apps
