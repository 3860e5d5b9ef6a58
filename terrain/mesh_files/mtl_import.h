#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::terrain {

/// Sets the materials of `soup`, by name, from the material libraries of the OBJ `path`: diffuse
/// colour (Kd, linear) and image (map_Kd). Libraries and images are in the OBJ's folder. Warns of
/// missing and unsupported ones. `storedChannels` as in ImageBudget.
void readMtl(const std::filesystem::path& path, const std::vector<std::string>& libraries,
             std::uint32_t storedChannels, Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
