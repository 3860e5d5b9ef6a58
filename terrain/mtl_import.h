#pragma once

#include "core/diagnostics.h"
#include "terrain/soup.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::terrain {

/// Gives the materials of `soup`, found by name, what the material libraries of the OBJ `path` say
/// of them: diffuse colour (Kd, linear) and image (map_Kd). Libraries and images lie beside the
/// OBJ. What is missing, or has no place here, is a warning.
void readMtl(const std::filesystem::path& path, const std::vector<std::string>& libraries,
             Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
