// The appearance of the blades of one species. Slots 0–7 of a field.
#ifndef SWARD_SHARED_SPECIES_H
#define SWARD_SHARED_SPECIES_H

#include "shaders/shared/shape.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint maxSpecies = 8u;

struct Species {
    vec3 rootColor;       ///< linear, at the root
    float tipThreshold;   ///< [0, 1): place along the blade where the taper to the tip begins
    vec3 tipColor;        ///< linear, at the tip
    float groundTint;     ///< [0, 1]: share of the ground's colour at the root
    float colorVariation; ///< [0, 1]: variation between blades and between clumps
    float translucency;   ///< [0, 1]: share of transmitted light
    float gloss;          ///< [0, 1]
    float dryness;        ///< [0, 1]: share of blades with yellowed tips
    uint shape;           ///< shapeTriangleTip … shapeLeaf
    float fold;           ///< [0, 1]; 1: the halves of the blade meet at a right angle
    uint firstOrgan;      ///< of a compound plant: index of its first organ …
    uint organKinds;      ///< … and number of its organs; 0: the species has only blades
};
SHARED_LAYOUT(Species, 64)

SHARED_BUFFER(SpeciesArray, Species, readonly)

SHARED_END
#endif
