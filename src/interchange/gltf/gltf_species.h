#pragma once

#include "field/field.h"
#include "interchange/blade_mesh.h"
#include "interchange/gltf/gltf_document.h"

#include <vector>

namespace sward::interchange {

inline constexpr const char* instancingExtension = "EXT_mesh_gpu_instancing";

/// Which meshes of each species a glTF holds.
enum class SpeciesLevels {
    full,
    coarse,
    both ///< first all full ones, then all coarse ones
};

/// Adds a mesh and a material for each of the n species; those of species i have index i. With both
/// levels its coarse mesh has index n + i. The extras of the full one then name it as `lod.mesh`,
/// and as `lod.below_pixels` the height of a blade on the screen below which both differ by at most
/// a quarter of a pixel along the curve.
void addSpecies(GltfDocument& document, const field::FieldView& field,
                const std::vector<MeanBlade>& means, SpeciesLevels levels = SpeciesLevels::full);

} // namespace sward::interchange
