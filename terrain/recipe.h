#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Makes the ground of a recipe (JSON, see terrain/README.md). Messages name `place`. A recipe of
/// kind "mesh" finds its file in `folder`, and keeps what masks `read`. Throws Error{input} for an
/// unknown key or value, and as load() does.
GroundMesh makeFromRecipe(std::string_view text, const std::string& place,
                          const std::filesystem::path& folder, Diagnostics& diagnostics,
                          const MaskInputs& read = {});

/// The recipe compiled in under this name; empty if there is none.
std::string_view builtInRecipe(std::string_view name);

/// Names of the recipes compiled in.
std::vector<std::string> builtInNames();

} // namespace sward::terrain
