// Push constants of each pass: the address of the frame, and a few numbers.
#ifndef SWARD_SHARED_PASSES_H
#define SWARD_SHARED_PASSES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/patch_tree.h"
#include "shaders/shared/tile_classification.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Visible blades are drawn as instances of this many patches. lavapipe 22.3 numbers the
/// tessellated vertices of a run of patches in 16 bits; 256 blades of 64 segments, 193 vertices
/// each, stay below that.
SHARED_CONST uint drawChunk = 256u;

/// Threads of a work-group of the update, one blade each. On an H200 64 take two fifths longer, 96
/// and 256 a seventh, 192 a hundredth: see decision 0031.
SHARED_CONST uint updateThreads = 128u;

/// Visible patches that a work-group of the update takes together: threads are idle only at the end
/// of the last patch, and patch data cost one wait. Three bits store the slot.
SHARED_CONST uint patchesTogether = 8u;

/// Minimum number of visible patches for work-groups with several patches each: with fewer groups
/// some of the device is idle at the end.
SHARED_CONST uint updateGroupsFrom = 3072u;

/// `ofGroup`: at most patchesTogether.
SHARED_FN uint updateGroups(uint patches, uint ofGroup)
{
    return min(patches, max(updateGroupsFrom, (patches + ofGroup - 1u) / ofGroup));
}

/// If the list of visible blades is too small for all blades of a field, visible patches are
/// updated and drawn in rounds; each round refills the list.
struct UpdatePush {
    FrameArray cullView; ///< frame with the culling camera
    VisiblePatchArray visiblePatches;
    WalkLevelArray levels;     ///< the first holds the number of visible patches
    WalkLevelArray nearCount;  ///< length of `near`, and work-groups for it
    UintArray near;            ///< places in the list of patches that a collider may touch
    WalkLevelArray rounds;     ///< each round's list length, and work-groups to rasterise it
    UintArray nonEmptyPatches; ///< indices of the non-empty patches
    FrameArray views;          ///< views for which blades are moved, if there are several
    UintArray before;          ///< receives the states before the motion, if they are kept
    UintArray history;         ///< see RasterPush; address 0: all blades are in the early list
    uint nonEmptyPatchCount;
    uint onlyUpdate; ///< 1: move all blades of all non-empty patches, cull and count none
    uint firstPatch; ///< the round's first visible patch …
    uint maxPatches; ///< … and the maximum number of its visible patches
    uint round;
    uint lateRound; ///< the round of the late list
    uint viewCount; ///< frames at `views`
    uint frame;     ///< running number; see forgetsHistory()
};
SHARED_LAYOUT(UpdatePush, 112)

/// A blade keeps its visibility history until it forgets it, in every 32nd frame. If all blades
/// forgot in every frame, parts that the wind shows only briefly would leave holes in the
/// occluders.
SHARED_CONST uint historyFrames = 32u;

SHARED_FN bool forgetsHistory(uint blade, uint frame)
{
    return (blade + frame) % historyFrames == 0u;
}

// Feature flags: code that a pipeline of the update contains and a frame may use. The tests of
// cullMask, and more.
SHARED_CONST uint featureThinning = 1u << 8u;      ///< a lodThreshold above 0
SHARED_CONST uint featureLeafAreaLimit = 1u << 9u; ///< maxLeafArea above 0
SHARED_CONST uint featurePages = 1u << 10u;        ///< only some blades may be in memory
SHARED_CONST uint featureCullResults = 1u << 11u;  ///< the cull result of each blade is recorded
SHARED_CONST uint featureOrgans = 1u << 12u;       ///< there are compound plants
SHARED_CONST uint featureAll = 0xffffffffu;

/// The features that a frame uses.
SHARED_FN uint featuresOf(Eyepoint view, bool isPaged, bool hasCullResults, bool hasOrgans)
{
    return view.cullMask | (view.lodThreshold > 0.0f ? featureThinning : 0u) |
           (view.maxLeafArea > 0.0f ? featureLeafAreaLimit : 0u) | (isPaged ? featurePages : 0u) |
           (hasCullResults ? featureCullResults : 0u) | (hasOrgans ? featureOrgans : 0u);
}

// Roles of the update of a visible patch.
SHARED_CONST uint moveAndCull = 0u;
SHARED_CONST uint onlyMove = 1u; ///< moves the blades that any view wants; lists nothing
SHARED_CONST uint onlyCull = 2u; ///< blades that are already moved

struct WalkPush {
    FrameArray cullView;
    SubtreeArray subtrees;            ///< by patch
    UintArray queue;                  ///< room for each patch once
    VisiblePatchArray visiblePatches; ///< room for each non-empty patch
    WalkLevelArray levels;            ///< one more than the levels of the tree
    uint startCount; ///< the walk begins with this many patches, the first of the array
    uint level;      ///< 0 for these together, then 1, 2, … for children beyond them
};
SHARED_LAYOUT(WalkPush, 48)

/// Threads of a work-group of the depth pyramid along each axis, one per cell of the finest level.
/// The work-group also fills the next two levels.
SHARED_CONST uint pyramidThreads = 16u;

/// One work-group with this many threads fills all levels from this one on.
SHARED_CONST uint pyramidFirstOfRest = 3u;
SHARED_CONST uint pyramidRestThreads = 256u;

struct PyramidPush {
    FrameArray frame;
    float slack; ///< depth by which drawn geometry is assumed farther
    uint reserved;
};
SHARED_LAYOUT(PyramidPush, 16)

/// Threads of a work-group of the rasteriser, one blade each.
SHARED_CONST uint rasterThreads = 64u;

/// Work-groups in one dimension that every device supports; beyond them threads loop.
SHARED_CONST uint maxGroups = 65535u;

/// A blade that covers more pixels is rasterised by a work-group instead of one thread. With
/// several samples per pixel the limit is divided by the root of their number.
SHARED_CONST float largeBladePixels = 64.0f;

/// A blade that covers more pixels is tested for occlusion by other grass, …
SHARED_CONST float testedPixels = 256.0f;

/// … or, on a device with a fast test, a blade above this limit.
SHARED_CONST float testedSmallPixels = 64.0f;

/// A large blade is rasterised by several work-groups, one per this many of its pixels, …
SHARED_CONST float partPixels = 4096.0f;

/// … but at most this many.
SHARED_CONST uint maxParts = 64u;

/// Capacity of the list of parts of large blades: some hundred layers of them over a picture of 2
/// million pixels. Blades beyond it are rasterised by one thread each.
SHARED_CONST uint maxLargeParts = 1048576u;

/// Capacity of the list of blades that reach through the near plane, or that have too many pixels
/// for a single thread.
SHARED_CONST uint maxCutBlades = 65536u;

/// Maximum pixels of a blade that one thread draws, if threads draw large blades, too. llvmpipe
/// ends all loops of an invocation after 65 535 iterations, which eight blades share there, and
/// each blade takes some more iterations than pixels.
SHARED_CONST float maxPixelsOfThread = 4096.0f;

/// Threads of a work-group that draws large blades; 5 bits number their cross-sections. With 64 an
/// H200 takes a twelfth longer.
SHARED_CONST uint largeThreads = 32u;

/// Number of large blades that a work-group draws together, so that its threads have work; fewer if
/// there are not enough blades for largeGroups work-groups.
SHARED_CONST uint largeTogether = 6u;
SHARED_CONST uint largeGroups = 4096u;

/// The same for the late pass, where most segments are hidden, and the threads of its work-groups.
SHARED_CONST uint lateTogether = 32u;
SHARED_CONST uint lateGroups = 2048u;
SHARED_CONST uint lateThreads = 128u;

/// Unit that draws the blades that cover many pixels: work-groups, or the thread of the blade.
SHARED_CONST uint largeToGroups = 0u;
SHARED_CONST uint largeToNone = 1u;

/// Number of large blades that a work-group takes at a time, of `listed` blades.
SHARED_FN uint largeOfGroup(uint listed)
{
    return min(max(listed / largeGroups, 1u), largeTogether);
}

/// Number of work-groups that draw them.
SHARED_FN uint groupsForLarge(uint listed)
{
    const uint together = largeOfGroup(listed);
    return min((listed + together - 1u) / together, maxGroups);
}

/// The same for the late pass, over all blades listed by then.
SHARED_FN uint lateOfGroup(uint listed)
{
    return min(max(listed / lateGroups, 1u), lateTogether);
}

SHARED_FN uint groupsForLate(uint listed)
{
    const uint together = lateOfGroup(listed);
    return min((listed + together - 1u) / together, maxGroups);
}

/// The task of a work-group: a large blade, or every `parts`-th bundle of its rows.
struct LargePart {
    vec3 v0; ///< the ribbon: see Ribbon
    float width;
    vec3 v1;
    float fold;
    vec3 v2;
    uint outline; ///< 0–7 shape, 8–15 segments, 16–31 Ribbon::seed
    vec3 axis;
    float tipThreshold;
    float scale;
    uint instance; ///< RasterPush::instance
    uint blade;    ///< resident id
    uint part; ///< 0–7 number of this part, 8–15 number of parts; 0: nothing, the list was full;
               ///< 16–22 the first drawn segment, 23–29 one past the last; after an early
               ///< pass the late pass draws all other segments
};
SHARED_LAYOUT(LargePart, 80)

/// LargePart::part.
SHARED_FN uint packPart(uint number, uint parts, uint begin, uint end)
{
    return number | (parts << 8u) | (begin << 16u) | (end << 23u);
}

/// Segments of a blade in the early pass, the first and one past the last: from the first to the
/// last of its quarters that are not late.
SHARED_FN uvec2 firstSegments(uint late, uint segments)
{
    const uint early = allQuarters & ~late;
    if (early == 0u)
        return uvec2(0u, 0u);
    return uvec2(beginOfQuarter(uint(findLSB(early)), segments),
                 beginOfQuarter(uint(findMSB(early)) + 1u, segments));
}

SHARED_BUFFER(LargePartArray, LargePart, )

// Places in RasterPush::largeCount.
SHARED_CONST uint largeParts = 0u; ///< listed parts, and work-groups for them
SHARED_CONST uint largeEarly = 1u; ///< count: parts of the early pass, which come first in the list
SHARED_CONST uint largeCut = 2u;   ///< blades in RasterPush::cut, and work-groups for them
SHARED_CONST uint largeLate = 3u;  ///< work-groups for the late pass; count: work-groups that
                                   ///< have filled their cells of the ground's pyramid

/// Blades that share an entry of the table from resident ids to patches.
SHARED_CONST uint nonEmptyPatchStride = 64u;

/// The value of each sample: 0 for the sky, then the triangles of opaque.h, then the blades by
/// resident id; above it the bits of the reversed depth. The larger value is nearer; at equal depth
/// the larger number wins, in any draw order. Ordered by column of pixels, rowsOfColumn() each,
/// then by sample: blades stand upright, so neighbouring threads access neighbouring memory.
SHARED_BUFFER(VisibilityArray, uvec2, )

/// Rounds up to four rows, which begin at a multiple of 32 bytes.
SHARED_FN uint rowsOfColumn(uint height)
{
    return (height + 3u) & ~3u;
}

/// Capacity of the shading cache: the large blades at the first places of the list, for all pixels
/// that show them, …
SHARED_CONST uint maxCachedBlades = 262144u;

/// … and size of its table by resident id modulo this: of two blades in an entry one is not cached.
SHARED_CONST uint cachePlaceCount = 1048576u;

/// Blades that share a word of RasterPush::history.
SHARED_CONST uint bladesOfHistoryWord = 32u / quarters;

/// The bit of a quarter of a blade in its word of RasterPush::history.
SHARED_FN uint historyBit(uint blade, uint quarter)
{
    return 1u << (quarters * (blade % bladesOfHistoryWord) + quarter);
}

struct RasterPush {
    FrameArray frame;
    FrameArray cullView; ///< whose camera selected the visible blades
    VisibilityArray visibility;
    WalkLevelArray rounds; ///< as in UpdatePush
    LargePartArray large;
    WalkLevelArray largeCount; ///< list lengths, and work-groups for the lists: see largeParts …
    LargePartArray cut;        ///< blades that reach through the near plane
    UintArray nonEmptyPatches; ///< non-empty patches, in the order of their blades
    UintArray firstNonEmptyPatches; ///< per nonEmptyPatchStride blades: index into nonEmptyPatches

    /// The visibility history: a bit for each quarter of each blade, by resident id, whether a
    /// sample has shown it lately, see forgetsHistory(). The early pass draws these quarters of
    /// large blades; the late pass draws all others that are not hidden. The bits decide the pass,
    /// never the visibility. Address 0: blades are not tested for occlusion by other blades.
    UintArray history;
    UintArray cachePlaces;    ///< per resident id modulo cachePlaceCount: the place in `large`
                              ///< of the last listed blade with such an id
    UintArray cachedSurfaces; ///< 12 words each: see shading_cache.glsl
    WalkLevelArray tiles;     ///< lists of tiles by content: see tile_classification.h
    uvec2 size;               ///< [pixels]
    uint isBgr;               ///< 1: the picture's first channel is blue
    uint round;      ///< round of the list to rasterise: its first blades, or its last ones
    uint firstBlade; ///< visibility value of the blade with id 0: see VisibilityArray
    uint instance;   ///< index of this instance in a view of several
};
SHARED_LAYOUT(RasterPush, 128)

/// Threads of a work-group that draws blades into a BladeShadow: so many blades of a patch at a
/// time. And work-groups of its dispatch: the patches are too few for one each.
SHARED_CONST uint bladeShadowThreads = 64u;
SHARED_CONST uint bladeShadowGroups = 4096u;

/// Segments of a blade there, drawn by a thread each.
SHARED_CONST uint bladeShadowSegments = 8u;

struct BladeShadowPush {
    VisiblePatchArray visiblePatches; ///< of the sun's view
    WalkLevelArray levels;            ///< the first holds their number
    VisibilityArray visibility;       ///< the map
    uvec2 size;                       ///< [texels]
    uint firstBlade;                  ///< 0: the map holds seeds instead of ids
    uint reserved;
};
SHARED_LAYOUT(BladeShadowPush, 40)

/// A collider is drawn as this many quads around its axis, in this many rings from each pole.
SHARED_CONST uint colliderSegments = 64u;
SHARED_CONST uint colliderRings = 16u;

/// Two for each quad of both halves, and of the ring between them.
SHARED_CONST uint colliderTriangles = 2u * colliderSegments * (2u * colliderRings + 1u);

struct ViewPush {
    FrameArray frame;
};
SHARED_LAYOUT(ViewPush, 8)

/// Change of a view of a field since the previous frame.
struct Motion {
    mat4 clipBefore;        ///< from the field's coordinates to the previous clip space
    UintArray statesBefore; ///< states before the motion, for blades that moved in this frame
    uint moves;             ///< 0: no blade has moved, no time has passed
    uint reserved;
};
SHARED_LAYOUT(Motion, 80)

SHARED_BUFFER(MotionArray, Motion, )

/// Tessellation of one list of visible blades.
struct BladePush {
    FrameArray frame;
    WalkLevelArray rounds; ///< as in UpdatePush
    MotionArray motion;    ///< address 0: off
    uint isLate;           ///< 1: of the blades listed from the back
    uint reserved;
};
SHARED_LAYOUT(BladePush, 32)

/// One instance of a field in a view of a host.
struct HostInstance {
    RasterPush raster;
    MotionArray motion;
};
SHARED_LAYOUT(HostInstance, 136)

SHARED_BUFFER(HostInstanceArray, HostInstance, readonly)

/// Side of the tiles in which a visibility is drawn into a host's picture [pixels].
SHARED_CONST uint hostTile = 64u;

/// Data of the stages that process all instances of a host's view together.
struct HostViewPush {
    HostInstanceArray instances; ///< in the order of their RasterPush::firstBlade
    VisibilityArray visibility;  ///< after lighting: packLight() instead of ids, unless stored
    UintArray motions;           ///< of each sample, two halves; address 0: off
    UintArray tiles;             ///< of hostTile² pixels, row after row: 1 if it shows a blade
    uvec2 size;                  ///< [pixels]
    uint instanceCount;
    float slack;       ///< depth by which the host's geometry is assumed farther
    uvec2 firstStored; ///< [pixels] where the view begins in the host's stored picture
    UintArray layers;  ///< LayersTable of the stage that writes layers; address 0: there are none
};
SHARED_LAYOUT(HostViewPush, 64)

// Flags of a pipeline that stores light into a host's picture.
SHARED_CONST uint storesPicture = 1u;
SHARED_CONST uint storesDeveloped = 1u << 1u; ///< tone-mapped; else radiance
SHARED_CONST uint storesSrgb = 1u << 2u;      ///< by sRGB's encoding
SHARED_CONST uint storesBgr = 1u << 3u;       ///< blue first
SHARED_CONST uint storesDepth = 1u << 4u;     ///< into a second image
SHARED_CONST uint storesForwardZ = 1u << 5u;  ///< of this convention; else reversed Z

/// Light that a half and packLight() can hold: 0 … 65 408.
SHARED_FN vec3 boundedLight(vec3 light)
{
    return clamp(light, vec3(0.0f), vec3(65408.0f));
}

/// Light in 32 bits: three mantissas of 9 bits and an exponent of 5 bits. Error: 1/512 of the
/// largest channel. Never 0, the visibility's value for no surface. Clamped to 65 408.
/// (EXT_texture_shared_exponent)
SHARED_FN uint packLight(vec3 light)
{
    const vec3 bounded = boundedLight(light);
    const float largest = max(max(bounded.x, bounded.y), max(bounded.z, 1.0f / 65536.0f));
    // 2^exponent is above the largest channel, also after rounding.
    const float exponent = floor(log2(largest * 1.0015f)) + 1.0f;
    const vec3 mantissas = round(bounded * exp2(9.0f - exponent));
    const uint packed = uint(min(mantissas.x, 511.0f)) | (uint(min(mantissas.y, 511.0f)) << 9u) |
                        (uint(min(mantissas.z, 511.0f)) << 18u) | (uint(exponent + 15.0f) << 27u);
    return max(packed, 1u);
}

SHARED_FN vec3 unpackLight(uint packed)
{
    const float scale = exp2(float(packed >> 27u) - 24.0f);
    return scale *
           vec3(float(packed & 511u), float((packed >> 9u) & 511u), float((packed >> 18u) & 511u));
}

/// Threads of a work-group that copies.
SHARED_CONST uint copyThreads = 256u;

struct CopyPush {
    UintArray from; ///< both aligned to 16 bytes
    UintArray to;
    uint count; ///< in units of 16 bytes
    uint reserved;
};
SHARED_LAYOUT(CopyPush, 24)

struct GroundPush {
    FrameArray frame;
    GroundVertexArray vertices;
    GroundMaterialArray materials;
    uint material;
    uint reserved;
};
SHARED_LAYOUT(GroundPush, 32)

/// Threads of a work-group that tests clusters of the ground, one each, and words of their bits.
SHARED_CONST uint groundThreads = 128u;
SHARED_CONST uint groundWords = groundThreads / 32u;

/// Culling of ground clusters. A first dispatch finds the visible clusters, a second writes their
/// draws, in the order of the clusters.
struct GroundCullPush {
    FrameArray frame;
    GroundClusterArray clusters; ///< of one part of the ground
    IndexedDrawArray draws;      ///< of all parts, at most one per cluster
    UintArray seen;              ///< a bit for each cluster
    UintArray drawCount;         ///< number of draws of the part
    uint clusterCount;
    uint firstCluster; ///< first cluster of the part
};
SHARED_LAYOUT(GroundCullPush, 48)

SHARED_END
#endif
