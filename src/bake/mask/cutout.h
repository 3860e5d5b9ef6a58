#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// The holes of materials that are cut out by alpha (glTF alphaMode MASK): where the alpha of base
/// colour, image and vertex colour, multiplied, is below the material's alphaCutoff. Thread-safe.
class Cutout {
public:
    /// The ground must outlive it. `colorsAreMask`: vertex colours are no colours, and their alpha
    /// is no alpha.
    Cutout(const terrain::GroundMesh& ground, bool colorsAreMask);

    /// Whether some bearing ground may have holes.
    bool isAny() const { return isAny_; }

    /// Whether a root lies in a hole.
    bool holds(const RootSample& root) const;

private:
    const terrain::GroundMesh& ground_;
    bool colorsAreMask_;
    bool isAny_ = false;
};

} // namespace sward::bake
