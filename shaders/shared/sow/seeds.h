// What bears in a 32 m cell, and the meadow that grows on it, as the sower reads them.
#ifndef SWARD_SHARED_SOW_SEEDS_H
#define SWARD_SHARED_SOW_SEEDS_H

#include "shaders/shared/species.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Lengths are whole numbers of units of 2^−unitBits m, from the low corner of the cell.

/// A corner of bearing triangles, and the up-vector there.
struct SeedVertex {
    int x;
    int y;
    int z;
    uint up; ///< x 0–9, y 10–19, z 20–29: each 511 + 511 times a component of the unit vector
};
SHARED_LAYOUT(SeedVertex, 16)

/// A bearing triangle side, or the part of it whose candidates (u, v) share p leading bits of u and
/// q of v. Candidate `i` of the triangle is entry `j` of the part: see sowCandidate().
struct SeedPiece {
    uint corners[3]; ///< vertices of the cell
    uint source;     ///< number of the triangle in the input
    uint count;      ///< entries; 0: it bears but clump centres here
    float expected;  ///< λA: expected number of candidates of the whole triangle side
    uint form;    ///< p 0–4, q 5–9, steps of the grid of conditions along s 10–17 and along v
                  ///< 18–25; 26–27: strokes make blades up to 2ⁿ times as high; back side 31
    uint low;     ///< the lowest p bits of all its candidates
    uint target;  ///< the lowest q bits of pascal(candidate)
    uint sStart;  ///< [2⁻³²] least s = √u
    uint sScale;  ///< grid steps in 2⁻⁴⁸ per 2⁻³² of s
    uint records; ///< first of its (steps + 1)·(steps + 1) conditions, v by v
    uint bits;    ///< first word of one bit an entry, set if it grows; noSeedBits: by density.
                  ///< Entries beyond the expected candidates, for which strokes ask, have bits
    uint creases; ///< word with the number of SeedCrease near it, then their first words; its
                  ///< corners have normals instead of up-vectors. noSeedBits: no crease is near
};
SHARED_LAYOUT(SeedPiece, 56)

SHARED_CONST uint noSeedBits = 0xffffffffu;

/// A convex crease: eight words of the cell. As terrain::ConvexCrease.
struct SeedCrease {
    int from[3];     ///< units
    int to[3];       ///< units
    uint normals[2]; ///< on either side, as SeedVertex::up
};
SHARED_LAYOUT(SeedCrease, 32)
SHARED_CONST uint seedCreaseWords = 8u;
SHARED_TABLE(SowWords, uint)

/// A centre of a clump in the cell or within reach of it.
struct SeedClump {
    uint piece;   ///< of the cell, of the triangle that it lies on
    uint number;  ///< on that triangle
    int moisture; ///< [2⁻¹⁴] of the ground there by its slope and hollow, [−2, 2]
};
SHARED_LAYOUT(SeedClump, 12)

/// Conditions at a place. Bytes are 255ths.
struct SeedConditions {
    uint growth; ///< density 0–15 (65535ths), exposure 16–23, share of dry blades 24–31
    uint look;   ///< tint red 0–7, green 8–15, blue 16–23; factor of stiffness 24–31
    uint size;   ///< factor of height 0–15 (8192ths), vigour 16–23, room above 24–31, in
                 ///< SowMeadow::room; 255: no bound
    uint lean;   ///< x 0–7, y 8–15, z 16–23: (127 + 127 times a component) of a direction, as
                 ///< long as the share by which blades turn to it
    uint share[2];  ///< share of the density of species 0–7, a byte each, if they are mixed; else
                    ///< what strokes sow, and the meadow's shares for the rest
    uint vigour[2]; ///< vigour of species 0–7, a byte each; if they are mixed or strokes sow any
};
SHARED_LAYOUT(SeedConditions, 32)

// Directions of the blades of a clump, as bake::Facing.
SHARED_CONST uint sowOutward = 0u;
SHARED_CONST uint sowShared = 1u;
SHARED_CONST uint sowFree = 2u;

/// A species: lengths in [m], at the field's blade scale.
struct SowSpecies {
    float share; ///< of the density
    float heightLow;
    float heightRange;
    float widthLow;
    float widthRange;
    float stiffnessLow;
    float stiffnessRange;
    float clumping; ///< [0, 1]
    uint facing;    ///< sowOutward, sowShared, sowFree
    uint ribbons;   ///< on each stalk
};
SHARED_LAYOUT(SowSpecies, 40)
SHARED_TABLE(SowSpeciesTable, SowSpecies)

/// The meadow.
struct SowMeadow {
    uint64_t seed;         ///< of all random numbers
    uint64_t clumpKey;     ///< of clump centres
    int64_t clumpReach;    ///< units; 0: no clumps
    uint unitBits;         ///< 11 to 24
    uint levels;           ///< number of the finest level: see sowLevel()
    uint speciesCount;     ///< 1 to 8
    uint isMixed;          ///< 1: shares and vigour of species are in all conditions
    float heightWaves;     ///< [0, 0.5]
    float drifts;          ///< [0, 1]
    float sparseHeight;    ///< [0, 1]
    float room;            ///< [m] of 255 in SeedConditions::size
    float heightsPerMetre; ///< 255 / largest height; of a cell, see sowHeightScale()
    float widthsPerMetre;  ///< 63 / largest width
    float wideVariation;   ///< [0, 1]
    float windX;           ///< unit with windZ: where lain grass lies on level ground
    float windZ;
    float creaseReach;   ///< [m] from a crease
    float creaseBlend;   ///< [0, 1]
    float vertical;      ///< [0, 1] how far blades grow along the ground's up-vector
    float metresPerUnit; ///< 2^−unitBits
    uint reserved;
    SowSpeciesTable species; ///< not in here: a shader would copy all of them for each index
};
SHARED_LAYOUT(SowMeadow, 104)

/// Up-vector of the ground in a cell.
struct SowGround {
    vec3 up;       ///< unit; if radial, from its centre to the low corner of the cell [m]
    uint isRadial; ///< 1: up points away from a centre
};
SHARED_LAYOUT(SowGround, 16)

/// A lattice of slow waves at a cell.
struct SowWave {
    uint64_t step;    ///< lattice cells in 2⁻⁴⁸ per unit
    uint cell[3];     ///< lattice point at or below the low corner of the cell, modulo 2³²
    uint fraction[3]; ///< [2⁻³²] from there to that corner
};
SHARED_LAYOUT(SowWave, 32)
SHARED_TABLE(SowWaves, SowWave)

// The waves of a cell: two of heights; two each of moist, of grazed and of lain patches; then of
// each species two of its drift, or of its colonies if it has ribbons, and two of its stands.
SHARED_CONST uint sowWideWaves = 2u;
SHARED_CONST uint sowSpeciesWaves = 8u;

/// Numbers of clumps, a byte each: 64 words of them by tone, then 64 of their places in that order.
SHARED_TABLE(SowTones, uint)

SHARED_END
#endif
