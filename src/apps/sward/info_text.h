#pragma once

#include "field/field.h"

#include <cstdint>
#include <string>

namespace sward::apps {

/// What is in a field file of `fileBytes`, for people.
std::string infoText(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes);

/// The same as JSON: lengths in metres, bounds in world space.
std::string infoJson(const std::string& file, const field::FieldView& field,
                     std::uint64_t fileBytes);

} // namespace sward::apps
