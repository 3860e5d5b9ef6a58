#pragma once

#include "field/field.h"

#include <filesystem>

namespace sward::tests {

/// A small valid field: one inner patch with two leaves, `bladesPerPatch` blades each, a ground of
/// two triangles with a 2×2 image, two species, a camera.
field::Field sampleField(std::uint32_t bladesPerPatch = 5);

/// A path in a folder of this process for temporary files; the folder is created.
std::filesystem::path temporaryFile(const std::string& name);

} // namespace sward::tests
