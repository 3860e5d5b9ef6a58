// What each pass is told through push constants: where the frame lies, and a few numbers.
#ifndef SWARD_SHARED_PASSES_H
#define SWARD_SHARED_PASSES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/patch_tree.h"
#include "shaders/shared/tile_classification.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Visible blades are drawn as instances of so many patches each. lavapipe 22.3 numbers the
/// tessellated vertices of a run of patches in 16 bits; 256 blades of 64 segments, 193 vertices
/// each, stay below that.
SHARED_CONST uint drawChunk = 256u;

/// Threads of a work-group of the update, one blade each. On an H200 64 take two fifths longer, 96
/// and 256 a seventh, 192 a hundredth: see decision 0031.
SHARED_CONST uint updateThreads = 128u;

/// A work-group of the update takes so many visible patches together, so that all threads have a blade
/// but at the end of the last patch, and waits once for what all of them say. Three bits say which.
SHARED_CONST uint patchesTogether = 8u;

/// Work-groups of the update for so many visible patches: fewer than a patch each only from here on,
/// since with fewer groups a device has some idle at the end.
SHARED_CONST uint updateGroupsFrom = 3072u;

/// `ofGroup`: patchesTogether, or fewer.
SHARED_FN uint updateGroups(uint patches, uint ofGroup)
{
    return min(patches, max(updateGroupsFrom, (patches + ofGroup - 1u) / ofGroup));
}

/// Where the list of visible blades has not room for all blades of a field, the visible patches are
/// updated and drawn in rounds, of which each fills the list anew.
struct UpdatePush {
    FrameArray cullView; ///< by whose camera blades are culled
    VisiblePatchArray live;
    WalkLevelArray levels; ///< the first says how many they are
    WalkLevelArray rounds; ///< each round's length of the list, and work-groups to rasterise it
    UintArray nonEmptyPatches;      ///< indices of the patches that own blades
    FrameArray views;      ///< for which blades are moved, where they are several
    UintArray before;      ///< where states are kept that blades are moved from, if they are
    UintArray seenBefore;  ///< see RasterPush; address 0: all blades are listed in front
    uint nonEmptyPatchCount;
    uint onlyUpdate; ///< 1: move every blade of every owner, cull and count none
    uint firstLive;  ///< the round's first visible patch …
    uint maxLive;   ///< … and how many it takes at most
    uint round;
    uint lateRound; ///< the same of those blades that are listed from behind
    uint viewCount; ///< frames at `views`
    uint frame;     ///< one after the other; see forgetsSeen()
};
SHARED_LAYOUT(UpdatePush, 96)

/// What a frame has shown of a blade counts as seen until the blade forgets it, in every 32nd
/// frame. If all forgot in each, what turns up and is gone again with every wind would leave holes
/// in what hides the rest.
SHARED_CONST uint framesSeen = 32u;

SHARED_FN bool forgetsSeen(uint blade, uint frame)
{
    return (blade + frame) % framesSeen == 0u;
}

// What a pipeline of the update has code for, and a frame may ask for: the tests of its cullMask,
// and more.
SHARED_CONST uint featureThinning = 1u << 8u; ///< a lodThreshold above 0
SHARED_CONST uint featureLeafAreaLimit = 1u << 9u;   ///< maxLeafArea above 0
SHARED_CONST uint featurePages = 1u << 10u;   ///< blades may be in memory in part
SHARED_CONST uint featureCullResults = 1u << 11u;   ///< the cull result of each blade is kept
SHARED_CONST uint featureAll = 0xffffffffu;

/// What of that a frame asks for.
SHARED_FN uint featuresOf(Eyepoint view, bool isPaged, bool hasCullResults)
{
    return view.cullMask | (view.lodThreshold > 0.0f ? featureThinning : 0u) |
           (view.maxLeafArea > 0.0f ? featureLeafAreaLimit : 0u) | (isPaged ? featurePages : 0u) |
           (hasCullResults ? featureCullResults : 0u);
}

// What the update does about a visible patch.
SHARED_CONST uint moveAndCull = 0u;
SHARED_CONST uint onlyMove = 1u;  ///< as far as any of the views asks; lists nothing
SHARED_CONST uint onlyCull = 2u; ///< where blades have been moved to

struct WalkPush {
    FrameArray cullView;
    SubtreeArray subtrees; ///< by patch
    UintArray queue;       ///< room for each patch once
    VisiblePatchArray live;   ///< room for each patch that owns blades
    WalkLevelArray levels; ///< as many as the tree has, and one
    uint startCount;       ///< patches of the levels that the walk begins with …
    uint startLevel;       ///< … of which this is the last
    uint level;            ///< 0 for those together, then 1, 2, …
    uint reserved;
};
SHARED_LAYOUT(WalkPush, 56)

/// Threads of a work-group of the depth pyramid along each axis, one per cell of the finest level:
/// with them go the next two.
SHARED_CONST uint pyramidThreads = 16u;

/// All levels from this one on are filled by one work-group of so many threads.
SHARED_CONST uint pyramidFirstOfRest = 3u;
SHARED_CONST uint pyramidRestThreads = 256u;

struct PyramidPush {
    FrameArray frame;
    float slack; ///< by which what was drawn is taken to be farther than its depth says
    uint reserved;
};
SHARED_LAYOUT(PyramidPush, 16)

/// Threads of a work-group of the rasteriser, one blade each.
SHARED_CONST uint rasterThreads = 64u;

/// Work-groups in one dimension that every device takes; beyond them threads loop.
SHARED_CONST uint maxGroups = 65535u;

/// A blade that covers more pixels than this is not rasterised by one thread, but by a work-group;
/// with several samples a pixel already one of so many pixels over the root of their number.
SHARED_CONST float largeBladePixels = 64.0f;

/// A blade that covers more pixels than this is asked for whether other grass hides it, …
SHARED_CONST float testedPixels = 256.0f;

/// … or, on a device that is quick to find that out, than this.
SHARED_CONST float testedSmallPixels = 64.0f;

/// A large blade is rasterised by several work-groups, each for so many of its pixels, …
SHARED_CONST float partPixels = 4096.0f;

/// … but no more of them than these.
SHARED_CONST uint maxParts = 64u;

/// So many parts of large blades can be listed: some hundred layers of them over a picture of 2
/// million pixels. Blades beyond them are rasterised by one thread each.
SHARED_CONST uint maxLargeParts = 1048576u;

/// So many blades can be listed that reach through the near plane, or of which a single thread must
/// not have so many pixels.
SHARED_CONST uint maxCutBlades = 65536u;

/// Where threads draw large blades, too, none draws one that may cover more pixels than this.
/// llvmpipe ends all loops of an invocation after 65 535 turns, which eight blades share there, and
/// each takes some more turns than pixels.
SHARED_CONST float maxPixelsOfThread = 4096.0f;

/// Threads of a work-group that draws large blades, which numbers their cross-sections in 5 bits. With 64 an
/// H200 takes a twelfth longer.
SHARED_CONST uint largeThreads = 32u;

/// A work-group draws so many large blades together, so that its threads have something to do, but
/// fewer where there are not enough for so many work-groups.
SHARED_CONST uint largeTogether = 6u;
SHARED_CONST uint largeGroups = 4096u;

/// The same of the late pass, where most segments are hidden, and of threads of such a work-group.
SHARED_CONST uint lateTogether = 32u;
SHARED_CONST uint lateGroups = 2048u;
SHARED_CONST uint lateThreads = 128u;

/// What draws the blades that cover many pixels: work-groups, or the thread that has the blade.
SHARED_CONST uint largeToGroups = 0u;
SHARED_CONST uint largeToNobody = 1u;

/// Of `listed` large blades a work-group takes so many at a time.
SHARED_FN uint largeOfGroup(uint listed)
{
    return min(max(listed / largeGroups, 1u), largeTogether);
}

/// Work-groups that draw them.
SHARED_FN uint groupsForLarge(uint listed)
{
    const uint together = largeOfGroup(listed);
    return min((listed + together - 1u) / together, maxGroups);
}

/// The same of the late pass, of all that are listed by then.
SHARED_FN uint lateOfGroup(uint listed)
{
    return min(max(listed / lateGroups, 1u), lateTogether);
}

SHARED_FN uint groupsForLate(uint listed)
{
    const uint together = lateOfGroup(listed);
    return min((listed + together - 1u) / together, maxGroups);
}

/// What a work-group draws: a large blade, or every `parts`-th bundle of its rows.
struct LargePart {
    vec3 v0; ///< the ribbon: see Ribbon
    float width;
    vec3 v1;
    float fold;
    vec3 v2;
    uint outline; ///< packOutline()
    vec3 axis;
    float tipThreshold;
    float scale;
    uint instance; ///< RasterPush::instance
    uint blade;    ///< resident id
    uint part;  ///< 0–7 which of so many parts, 8–15; 0: nothing, there was no room for all parts;
                ///< 16–22 the first segment that is drawn, 23–29 one past the last; of a blade that
                ///< had its early pass all others are left to the late one
};
SHARED_LAYOUT(LargePart, 80)

/// LargePart::outline.
SHARED_FN uint packOutline(uint shape, uint segments)
{
    return shape | (segments << 16u);
}

SHARED_FN uint shapeOfOutline(uint outline)
{
    return outline & 0xffffu;
}

SHARED_FN uint segmentsOfOutline(uint outline)
{
    return outline >> 16u;
}

/// LargePart::part.
SHARED_FN uint packPart(uint number, uint parts, uint begin, uint end)
{
    return number | (parts << 8u) | (begin << 16u) | (end << 23u);
}

/// Between which segments a blade is drawn in the early pass, the first and one past the last:
/// those of its quarters that are not late, and what lies between them.
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
SHARED_CONST uint largeParts = 0u; ///< parts that were listed, and work-groups for them
SHARED_CONST uint largeEarly = 1u; ///< count: so many of them, the first, the early pass has drawn
SHARED_CONST uint largeCut = 2u;   ///< blades in RasterPush::cut, and work-groups for them
SHARED_CONST uint largeLate = 3u;  ///< work-groups for the late pass; count: work-groups that have
                                   ///< filled their cells of the ground's pyramid

/// Blades that share an entry of the table from resident ids to patches.
SHARED_CONST uint nonEmptyPatchStride = 64u;

/// Per sample what is seen there: 0 is the sky, then come the triangles of opaque.h, then the blades
/// by their resident ids; above that the bits of the reversed depth. The larger is nearer, and
/// among equals the later one wins, whoever comes first. Column by column of pixels, rowsOfColumn()
/// each, then sample by sample: blades stand upright, and what threads beside one another read and
/// write of them so lies together.
SHARED_BUFFER(VisibilityArray, uvec2, )

/// Four rows begin at a multiple of 32 bytes.
SHARED_FN uint rowsOfColumn(uint height)
{
    return (height + 3u) & ~3u;
}

/// Of the large blades at so many places what shading asks of them is kept for all pixels that show
/// them, …
SHARED_CONST uint maxSurfaces = 262144u;

/// … and where it may be by resident id modulo this: of two that meet there one is shaded without.
SHARED_CONST uint surfacePlaceCount = 1048576u;

/// Blades that share a word of RasterPush::seen.
SHARED_CONST uint seenOfWord = 32u / quarters;

/// The bit of a quarter of a blade in its word of RasterPush::seen.
SHARED_FN uint seenBit(uint blade, uint quarter)
{
    return 1u << (quarters * (blade % seenOfWord) + quarter);
}

struct RasterPush {
    FrameArray frame;
    FrameArray cullView; ///< by whose camera the visible blades were listed
    VisibilityArray visibility;
    WalkLevelArray rounds; ///< as in UpdatePush
    LargePartArray large;
    WalkLevelArray largeCount; ///< how many are listed, and work-groups for them: see largeParts …
    LargePartArray cut;        ///< those that are cut by the near plane
    UintArray nonEmptyPatches;          ///< patches that own blades, in the order of their blades
    UintArray firstNonEmptyPatches; ///< per nonEmptyPatchStride blades: index into `nonEmptyPatches` of the first one's patch

    /// The visibility history: a bit for each quarter of each blade, by its resident id, whether a
    /// sample has shown it lately, see forgetsSeen(). The early pass draws those quarters of large
    /// blades, the late pass all others that are not hidden: the bits decide when something is
    /// drawn, and never whether it is seen. Address 0: blades are not asked whether others hide
    /// them.
    UintArray seen;
    UintArray surfacePlaces; ///< per resident id modulo surfacePlaceCount: the place in `large`
                             ///< where a blade with such an id was listed last
    UintArray surfaces;      ///< 12 words each: see shading_cache.glsl
    WalkLevelArray tiles;    ///< by what they show: see tile_classification.h
    uvec2 size;              ///< [pixels]
    uint isBgr;              ///< 1: the picture's first channel is blue
    uint round;              ///< whose list is rasterised: its first blades, or its last ones
    uint firstBlade; ///< what the visibility has for the blade with the id 0: see VisibilityArray
    uint instance;   ///< of a view that shows several: which one this is
};
SHARED_LAYOUT(RasterPush, 128)

/// A collider is drawn as so many quads around its axis, in so many rings from each pole.
SHARED_CONST uint colliderSegments = 64u;
SHARED_CONST uint colliderRings = 16u;

/// Two in each quad: of both halves, and of what joins them.
SHARED_CONST uint colliderTriangles = 2u * colliderSegments * (2u * colliderRings + 1u);

struct ViewPush {
    FrameArray frame;
};
SHARED_LAYOUT(ViewPush, 8)

/// How a view of a field came about since the frame before.
struct Motion {
    mat4 clipBefore;        ///< from the field's places to the clip space of then
    UintArray statesBefore; ///< of blades before they moved, where they have moved in this frame
    uint moves;             ///< 0: none has, no time has passed
    uint reserved;
};
SHARED_LAYOUT(Motion, 80)

SHARED_BUFFER(MotionArray, Motion, )

struct MotionPush {
    FrameArray frame;
    MotionArray motion;
};
SHARED_LAYOUT(MotionPush, 16)

/// One instance of a field in a view of a host.
struct HostInstance {
    RasterPush raster;
    MotionArray motion;
};
SHARED_LAYOUT(HostInstance, 136)

SHARED_BUFFER(HostInstanceArray, HostInstance, readonly)

/// What the stages know that look at all instances of a host's view together.
struct HostViewPush {
    HostInstanceArray instances; ///< in the order of their RasterPush::firstBlade
    VisibilityArray visibility;  ///< when it is lit: packLight() instead of what is seen
    UintArray motions;           ///< of each sample, two halves; address 0: not wanted
    uvec2 size; ///< [pixels]
    uint instanceCount;
    float slack; ///< by which the host's depth is taken to be farther than it says
};
SHARED_LAYOUT(HostViewPush, 40)

/// Light in 32 bits, of three mantissas of 9 bits and an exponent of 5: within 1/512 of the largest
/// channel. Never 0, which the visibility has where nothing is seen. Above 65 408 it is cut off.
/// (EXT_texture_shared_exponent)
SHARED_FN uint packLight(vec3 light)
{
    const vec3 bounded = clamp(light, vec3(0.0f), vec3(65408.0f));
    const float largest = max(max(bounded.x, bounded.y), max(bounded.z, 1.0f / 65536.0f));
    // 2^exponent is above the largest, also after rounding.
    const float exponent = floor(log2(largest * 1.0015f)) + 1.0f;
    const vec3 mantissas = round(bounded * exp2(9.0f - exponent));
    const uint packed = uint(min(mantissas.x, 511.0f)) | (uint(min(mantissas.y, 511.0f)) << 9u) |
                        (uint(min(mantissas.z, 511.0f)) << 18u) | (uint(exponent + 15.0f) << 27u);
    return max(packed, 1u);
}

SHARED_FN vec3 unpackLight(uint packed)
{
    const float scale = exp2(float(packed >> 27u) - 24.0f);
    return scale * vec3(float(packed & 511u), float((packed >> 9u) & 511u), float((packed >> 18u) & 511u));
}

/// Threads of a work-group along each axis that begins a visibility with the host's depth.
SHARED_CONST uint seedThreads = 8u;

/// Threads of a work-group that copies.
SHARED_CONST uint copyThreads = 256u;

struct CopyPush {
    UintArray from; ///< both at a multiple of 16
    UintArray to;
    uint count; ///< of 16 bytes each
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

/// Threads of a work-group that looks at clusters of the ground, one each, and words of their bits.
SHARED_CONST uint groundThreads = 128u;
SHARED_CONST uint groundWords = groundThreads / 32u;

/// Which clusters of the ground are drawn. A first dispatch finds those that are seen, a second
/// writes their draws, in the order of the clusters.
struct GroundCullPush {
    FrameArray frame;
    GroundClusterArray clusters; ///< of one part of the ground
    IndexedDrawArray draws;      ///< as many
    UintArray seen;              ///< a bit for each cluster
    UintArray drawCount;         ///< of them all
    uint clusterCount;
    uint firstCluster; ///< of the part among all
};
SHARED_LAYOUT(GroundCullPush, 48)

SHARED_END
#endif
