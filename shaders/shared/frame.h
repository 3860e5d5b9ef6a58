// What one frame's passes know.
#ifndef SWARD_SHARED_FRAME_H
#define SWARD_SHARED_FRAME_H

#include "shaders/shared/blade.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/occlusion.h"
#include "shaders/shared/update_rate.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/shape.h"
#include "shaders/shared/species.h"
#include "shaders/shared/sun_shadow.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// A blade that survived culling.
struct VisibleBlade {
    uint blade; ///< index into the blades: the resident id
    uint patchIndex;
    uint factors; ///< packFactors(): 1, or more where level of detail has left blades out; and
                  ///< which quarters of the blade are late
    float pixels; ///< height on the screen [pixels]
};
SHARED_LAYOUT(VisibleBlade, 16)

/// So many times as wide and as high as it is a blade is drawn, as two halves of a float, of which
/// the second, 1 to less than 2, has the upper 6 bits of 1 always.
SHARED_CONST uint heightFactorBits = 0x03ff0000u;

SHARED_FN uint packFactors(float width, float height)
{
    return packHalf2x16(vec2(width, height)) & (heightFactorBits | 0xffffu);
}

/// In times the blade's own width.
SHARED_FN float widthFactorOf(VisibleBlade visible)
{
    return unpackHalf2x16(visible.factors).x;
}

/// In times the blade's own height.
SHARED_FN float heightFactorOf(VisibleBlade visible)
{
    return unpackHalf2x16((visible.factors & heightFactorBits) | 0x3c000000u).y;
}

/// Where large blades hide one another, some of a blade's quarters are drawn in a late pass: which,
/// are bits, the lowest of that at its root. In VisibleBlade::factors they are shifted by so many.
SHARED_CONST uint quarters = 4u;
SHARED_CONST uint allQuarters = 15u;
SHARED_CONST uint lateShift = 28u;

/// The first segment of quarter `i`, of so many of a blade; `quarters`: one past the last.
SHARED_FN uint beginOfQuarter(uint i, uint segments)
{
    return i * segments / quarters;
}

/// The last quarter that begins at segment `i` or before: the one to which that belongs. Of the
/// whole numbers (4 i + 3) / segments, which a quarter of a segment more keeps clear of rounding.
SHARED_FN uint quarterOf(float i, float segments)
{
    return uint((4.0f * i + 3.25f) / segments);
}

/// VkDrawIndirectCommand, and the counts by cull result behind it.
struct DrawArguments {
    uint vertexCount;   ///< drawChunk (passes.h): so many blades in one instance
    uint instanceCount; ///< as many as the visible blades need; the last may be part empty
    uint firstVertex;
    uint firstInstance;
    uint simulated; ///< blades moved in this frame
    uint cullResults[7];  ///< blades by cull result, cullResultDrawn … cullResultLod; cullResultDrawn is the list's length
};
SHARED_LAYOUT(DrawArguments, 48)

SHARED_BUFFER(VisibleArray, VisibleBlade, )
SHARED_BUFFER(DrawArray, DrawArguments, )
SHARED_BUFFER(FloatArray, float, )
SHARED_BUFFER(UintArray, uint, )

/// One view of one field. All places are relative to the field's origin.
struct Frame {
    BladeArray blades;
    UintArray states; ///< BladeState::turn of each blade in memory …
    FloatArray etas;  ///< … and BladeState::eta, or address 0 where no collider has been
    PatchArray patches;
    SpeciesArray species;
    VisibleArray visible;
    DrawArray draw;
    FloatArray patchTimes; ///< per patch: the time its blades were last moved to [s] …
    UintArray patchCounts; ///< … and how many of them, the first so many
    UintArray cullResults;       ///< per blade in memory: its cull result, or address 0 when nobody asks
    UintArray pages;       ///< where each page of blades lies in memory (pages.h); address 0: all
                           ///< blades are there, in their order
    DepthPyramid pyramid;  ///< what the ground hides; without depths nothing

    mat4 viewProjection; ///< reversed Z: 1 near, 0 far
    vec3 rays[3];        ///< see rayThrough(): by how much the ray through a place of the picture
                         ///< turns to its right and downwards, and the one through the middle
    float depthOfEye;    ///< what viewProjection makes of the eye's depth
    Eyepoint view;
    Environment environment;
    uint patchCount;
    uint bladeCount;
    uint visibleCapacity;
    uint maxTessellation;    ///< largest tessellation level along a blade
    vec3 sunDirection;       ///< unit, towards the sun
    float exposure;          ///< scale from radiance to the picture
    vec3 sunColor;           ///< linear radiance
    uint debugMode;          ///< 0 none, 1 lod, 2 patches, 3 wind, 4 reason
    vec3 skyColor;           ///< linear radiance from above
    float fogDensity;        ///< [1/m] at the eye
    vec3 groundColor;        ///< linear radiance from below
    vec3 skyUp;              ///< unit; where the sky is
    float fixedTessellation; ///< > 0: this level for every blade
    float clouds;            ///< [0, 1] share of the sky
    LevelSteps levelSteps;
    UpdateRate updateRate;

    Cover cover;      ///< how much grass stands where
    SunShadow shadow; ///< what of the ground stands in the sun's light
    float
        fogFalloff; ///< [1/m] the air thins upwards as exp(−falloff · height); 0: alike everywhere
    float lowSun;   ///< [0, 1]: 1 where the sun stands on the horizon or below

    float time;        ///< [s]
    uint reserved[55]; ///< frames that lie on end begin where any device takes constants
};
SHARED_LAYOUT(Frame, 1536)

SHARED_BUFFER(FrameArray, Frame, readonly)

SHARED_END
#endif
