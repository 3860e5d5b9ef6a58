#pragma once

#include "unit/terrain/gltf/glb_builder.h"

#include <string>

namespace sward::terrain {

// Grounds compressed by the codecs' own encoders, and the same ground plain.

/// A wavy grid of `cells` × `cells` cells, one mesh of positions, normals, texture coordinates and
/// indices, all in 32 bits.
GlbBuilder plainGrid(unsigned cells);

struct MeshoptLook {
    std::string extension = "EXT_meshopt_compression";
    std::string indexMode = "TRIANGLES"; ///< or INDICES
    bool shortIndices = false;           ///< of 16 bits
    bool filters = false;                ///< octahedral normals of 8 bits, exponential positions
};

/// plainGrid() with every buffer view compressed; the views lie in a placeholder buffer.
GlbBuilder meshoptGrid(unsigned cells, const MeshoptLook& look = {});

struct DracoLook {
    bool edgebreaker = true; ///< else sequential, which keeps the order of vertices and triangles
    int bits = 0;            ///< of quantised positions and normals; 0: not quantised
};

/// plainGrid() with its primitive compressed; no plain copy.
GlbBuilder dracoGrid(unsigned cells, const DracoLook& look = {});

} // namespace sward::terrain
