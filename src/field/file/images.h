#pragma once

#include "field/field.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

// Ground images as a byte sequence: per image its width, height (uint32) and pixels.

std::vector<std::byte> imagesBytes(const std::vector<Image>& images);

/// Throws Error{input} naming `place` if sizes and bytes disagree.
std::vector<Image> parseImages(std::span<const std::byte> bytes, const std::string& place);

} // namespace sward::field
