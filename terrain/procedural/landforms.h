#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/procedural/noise.h"

#include <cstdint>

namespace sward::terrain {

struct HillsSettings {
    HeightGrid grid{};
    std::uint64_t seed = 1;
    double height = 12.0; ///< [m] heights stay inside ± this
    double width = 16.0;  ///< [m] of the widest hills
    Octaves octaves{};
};

/// Rolling hills: a fractal heightfield.
GroundMesh makeHills(const HillsSettings& settings = {});

struct DunesSettings {
    HeightGrid grid{};
    std::uint64_t seed = 1;
    double height = 2.5;   ///< [m] of a crest above the foot
    double spacing = 12.0; ///< [m] from crest to crest, along x
    double wander = 4.0;   ///< [m] amplitude of the crests' bends
};

/// Dunes across the wind, which blows along +x: a long windward slope, a short steep lee.
GroundMesh makeDunes(const DunesSettings& settings = {});

struct ArchSettings {
    double span = 5.0;       ///< [m] from the arch's centre to the centre of its foot
    double thickness = 1.2;  ///< [m] radius of the rock, below span
    double roughness = 0.35; ///< [m] amplitude of the rock's surface
    double patch = 24.0;     ///< [m] side of the ground around it
    std::uint64_t seed = 1;
};

/// A rock arch over gentle ground; gives ground below an overhang. Nodes "ground" and "arch"; the
/// arch is a closed body with its feet in the ground.
GroundMesh makeArch(const ArchSettings& settings = {});

} // namespace sward::terrain
