#pragma once

#include "terrain/load.h"

#include <string>

namespace sward::terrain {

/// What a name of a material or node says about the ground.
enum class NameSays { nothing, bare, grass };

/// Reads the words of `name`: runs of letters, split where a small letter meets a capital and at
/// everything else. Case does not matter; a word may be a plural. A word for grass wins over one
/// for bare ground, and only whole words count: "Rock_01", "mossRocks" and "rocket" say bare,
/// grass and nothing. docs/algorithms/masks.md lists the words.
NameSays readName(const std::string& name);

/// Clears `bears` where names say that ground is bare: the material's name decides, else that of
/// the nearest node above. A name that belongs to the whole mesh tells nothing apart and does not
/// count; neither do those of a kind that `settings` choose by globs. If nothing would bear grass,
/// all stays. Warns with the names and their share of the area. `place` is the file.
void leaveBareByName(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                     Diagnostics& diagnostics);

} // namespace sward::terrain
