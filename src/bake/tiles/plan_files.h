#pragma once

#include "bake/settings/settings.h"

#include <span>
#include <string>
#include <vector>

namespace sward::bake {

/// What a tile reads beside its part of the ground, as it was for the plan.
struct PlanFile {
    std::string name; ///< file, or built-in meadow, as the options name it
    std::string hash; ///< of its content, 16 hex digits
};

/// The meadow that `meadow` names, the files of all masks, of species too, and of excluded areas,
/// which have to be loaded. Images and meshes count by what is read of them, the files of maps by
/// terrain::mapFileHash(). Strokes are not among them (TilePlan::paint). Throws Error{io}.
std::vector<PlanFile> planFiles(const BakeSettings& settings, const std::string& meadow);

/// Throws Error{input} that names the first of `found` that is not as in `planned`, those of the
/// plan in file `plan`.
void requireUnchanged(std::span<const PlanFile> planned, std::span<const PlanFile> found,
                      const std::string& plan);

} // namespace sward::bake
