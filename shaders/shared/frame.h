// The data of one frame that its passes read.
#ifndef SWARD_SHARED_FRAME_H
#define SWARD_SHARED_FRAME_H

#include "shaders/shared/blade.h"
#include "shaders/shared/look/blade_shadow.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/host_light.h"
#include "shaders/shared/look/floor_plane.h"
#include "shaders/shared/occlusion.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/shape.h"
#include "shaders/shared/species.h"
#include "shaders/shared/sun_shadow.h"
#include "shaders/shared/types.h"
#include "shaders/shared/update_rate.h"

SHARED_BEGIN

/// A blade that survived culling.
struct VisibleBlade {
    uint blade; ///< index into the blades: the resident id
    uint patchIndex;
    uint factors; ///< packFactors(): 1, or more if level of detail leaves blades out; and
                  ///< the late quarters of the blade
    float pixels; ///< height on the screen [pixels]
};
SHARED_LAYOUT(VisibleBlade, 16)

/// Width and height factor of a drawn blade, as two half floats. The height factor is in [1, 2), so
/// its upper 6 bits are always those of 1.
SHARED_CONST uint heightFactorBits = 0x03ff0000u;

SHARED_FN uint packFactors(float width, float height)
{
    return packHalf2x16(vec2(width, height)) & (heightFactorBits | 0xffffu);
}

/// In units of the blade's own width.
SHARED_FN float widthFactorOf(VisibleBlade visible)
{
    return unpackHalf2x16(visible.factors).x;
}

/// In units of the blade's own height.
SHARED_FN float heightFactorOf(VisibleBlade visible)
{
    return unpackHalf2x16((visible.factors & heightFactorBits) | 0x3c000000u).y;
}

/// If large blades hide one another, some quarters of a blade are drawn in the late pass: one bit
/// each, the lowest at the root. VisibleBlade::factors stores the bits shifted by lateShift.
SHARED_CONST uint quarters = 4u;
SHARED_CONST uint allQuarters = 15u;
SHARED_CONST uint lateShift = 28u;

/// The first segment of quarter `i` of `segments` segments; `quarters`: one past the last.
SHARED_FN uint beginOfQuarter(uint i, uint segments)
{
    return i * segments / quarters;
}

/// The quarter of segment `i`: the last quarter that begins at segment `i` or before. Equals
/// floor((4 i + 3) / segments); the additional quarter of a segment avoids rounding errors.
SHARED_FN uint quarterOf(float i, float segments)
{
    return uint((4.0f * i + 3.25f) / segments);
}

/// VkDrawIndirectCommand, followed by the counts by cull result.
struct DrawArguments {
    uint vertexCount;   ///< drawChunk (passes.h): blades per instance
    uint instanceCount; ///< enough for the visible blades; the last may be partly empty
    uint firstVertex;
    uint firstInstance;
    uint simulated;      ///< blades moved in this frame
    uint cullResults[7]; ///< blades by cull result; cullResultDrawn is the list's length
};
SHARED_LAYOUT(DrawArguments, 48)

SHARED_BUFFER(VisibleArray, VisibleBlade, )
SHARED_BUFFER(DrawArray, DrawArguments, )
SHARED_BUFFER(FloatArray, float, )
SHARED_BUFFER(UintArray, uint, )

/// One view of one field. All positions are relative to the field's origin.
struct Frame {
    BladeArray blades;
    UintArray states; ///< BladeState::turn of each blade in memory …
    FloatArray etas;  ///< … and BladeState::eta, or address 0 if there has been no collider
    PatchArray patches;
    SpeciesArray species;
    OrganTable organs; ///< of all species; address 0: there are no compound plants
    VisibleArray visible;
    DrawArray draw;
    UintArray patchTimes;     ///< per patch: the tick of its blades' last update …
    UintArray patchCounts;    ///< … and the number of blades, from its first, that were moved
    UintArray cullResults;    ///< cull result per blade in memory, or address 0 if off
    UintArray pages;          ///< place of each page of blades in memory (pages.h); address 0: all
                              ///< blades are in memory, in order
    HostLightArray hostLight; ///< the host's light; address 0: only the light of this frame
    DepthPyramid pyramid;     ///< depths of the ground; without depths it hides nothing

    mat4 viewProjection; ///< reversed Z: 1 near, 0 far
    vec3 rays[3];        ///< see rayThrough(): change of the ray per place of the picture,
                         ///< to the right and down, and the ray through the middle
    float depthOfEye;    ///< clip z of the eye under viewProjection
    Eyepoint view;
    Environment environment;
    uint patchCount;
    uint bladeCount;
    uint visibleCapacity;
    uint maxTessellation;    ///< maximum tessellation level along a blade
    vec3 sunDirection;       ///< unit, towards the sun
    float exposure;          ///< scale from radiance to the picture
    vec3 sunColor;           ///< linear radiance
    uint debugMode;          ///< 0 none, 1 lod, 2 patches, 3 wind, 4 reason
    vec3 skyColor;           ///< linear radiance from above
    float fogDensity;        ///< [1/m] at the eye
    vec3 groundColor;        ///< linear radiance from below
    vec3 skyUp;              ///< unit; direction to the sky
    float fixedTessellation; ///< > 0: this level for every blade
    float clouds;            ///< [0, 1] share of the sky
    LevelSteps levelSteps;
    UpdateRate updateRate;

    Cover cover;             ///< density of the grass
    SunShadow shadow;        ///< shadow of the ground
    BladeShadow bladeShadow; ///< shadow of the blades near the eye
    float
        fogFalloff; ///< [1/m] the air thins upwards as exp(−falloff · height); 0: constant density
    float lowSun;   ///< [0, 1]: 1 for a sun on the horizon or below

    uint tick;             ///< time of the frame, see ticksPerSecond
    FloorPlane floorPlane; ///< below the viewer's ground
    uint reserved[36];     ///< padding: consecutive frames meet any offset alignment of constants
};
SHARED_LAYOUT(Frame, 2048)

SHARED_BUFFER(FrameArray, Frame, readonly)

SHARED_END
#endif
