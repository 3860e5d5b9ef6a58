// Ids of all specialisation constants, for both sides. An id belongs to one constant, whose GLSL
// name follows "id":
//     layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;
// A pipeline may give constants that a stage does not have.
#ifndef SWARD_SHARED_CONSTANTS_H
#define SWARD_SHARED_CONSTANTS_H

#include "shaders/shared/types.h"

SHARED_BEGIN

// Of views and pictures.
SHARED_CONST uint idKnownDebugMode = 0u;  ///< debugNothing …
SHARED_CONST uint idSamplesPerPixel = 1u; ///< 1 or 4
SHARED_CONST uint idHasForwardZ = 2u;     ///< depths are 0 near and 1 far; else 1 near and 0 far
SHARED_CONST uint idOutputMode = 3u;      ///< outputFilm …
SHARED_CONST uint idWritesMotion = 4u;    ///< beside the colour
SHARED_CONST uint idStoredAs = 5u;        ///< flags storesPicture …: see passes.h

// Of what blades a field has.
SHARED_CONST uint idIsPaged = 6u;       ///< its blades lie on pages
SHARED_CONST uint idOnlyShape = 7u;     ///< the shape of all blades; shapeCount if they differ
SHARED_CONST uint idMayFold = 8u;       ///< blades may be folded
SHARED_CONST uint idMayHaveOrgans = 9u; ///< there may be compound plants

// Of update and cull.
SHARED_CONST uint idRole = 10u;           ///< moveAndCull …
SHARED_CONST uint idTakes = 11u;          ///< takesAll …: the patches
SHARED_CONST uint idFeatures = 12u;       ///< see featuresOf()
SHARED_CONST uint idWindCounts = 13u;     ///< Wind::counts; 0: nothing is moved
SHARED_CONST uint idHasColliders = 14u;   ///< else no blade is near one
SHARED_CONST uint idKeepsBefore = 15u;    ///< stores states before the motion
SHARED_CONST uint idKeepsEtas = 16u;      ///< stores the collision state
SHARED_CONST uint idTestsSmall = 17u;     ///< see testedSmallPixels
SHARED_CONST uint idPatchesOfGroup = 18u; ///< that a work-group takes together
SHARED_CONST uint idThreadsOfGroup = 19u; ///< of the update

// Of rasteriser and resolve.
SHARED_CONST uint idLargeTo = 20u;         ///< largeToGroups …
SHARED_CONST uint idFillsAll = 21u;        ///< all levels of the pyramid; else the finest
SHARED_CONST uint idIsOfColliders = 22u;   ///< triangles of colliders; else of the ground
SHARED_CONST uint idDrawsSunMap = 23u;     ///< else the picture
SHARED_CONST uint idWritesDraws = 24u;     ///< of the ground that is seen; else finds that
SHARED_CONST uint idTileList = 25u;        ///< tilesOfBlades …: see tile_classification.h
SHARED_CONST uint idShowsBlades = 26u;     ///< the tiles may show blades
SHARED_CONST uint idShowsSky = 27u;        ///< … and sky
SHARED_CONST uint idHasShadingCache = 28u; ///< see shading_cache.glsl
SHARED_CONST uint idHasHostLight = 29u;    ///< blades are in a host's light: see host_light.h
SHARED_CONST uint idLimitsLeafArea = 30u;  ///< see leafAreaLimitOf()

// Debug modes that are known at pipeline creation; see Frame::debugMode.
SHARED_CONST uint debugNothing = 0u;         ///< the normal picture
SHARED_CONST uint debugWind = 3u;            ///< ground and blades show the wind's speed
SHARED_CONST uint debugAsTold = 0xffffffffu; ///< the frame's mode, which is not debugWind

// Output modes.
SHARED_CONST uint outputFilm = 0u;     ///< Sward's own film, for the viewer
SHARED_CONST uint outputHost = 1u;     ///< a host's picture, through the film curve
SHARED_CONST uint outputRadiance = 2u; ///< exposed radiance, for a host's own film curve
SHARED_CONST uint outputNone = 3u;     ///< depth only

SHARED_END
#endif
