#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Reads every shared struct member by member and writes what it has read as a row of words.
#include "shaders/shared/layers/layers_table.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/opaque.h"

layout(local_size_x = 1) in;

SHARED_BUFFER(PlainBladeArray, Blade, readonly)
SHARED_BUFFER(UpdatePushArray, UpdatePush, readonly)
SHARED_BUFFER(WalkPushArray, WalkPush, readonly)
SHARED_BUFFER(LayersPushArray, LayersPush, readonly)
SHARED_BUFFER(PyramidPushArray, PyramidPush, readonly)
SHARED_BUFFER(ViewPushArray, ViewPush, readonly)
SHARED_BUFFER(BladeShadowPushArray, BladeShadowPush, readonly)
SHARED_BUFFER(CopyPushArray, CopyPush, readonly)
SHARED_BUFFER(BladePushArray, BladePush, readonly)
SHARED_BUFFER(HostViewPushArray, HostViewPush, readonly)
SHARED_BUFFER(GroundPushArray, GroundPush, readonly)
SHARED_BUFFER(PagePushArray, PagePush, readonly)
SHARED_BUFFER(GroundCullPushArray, GroundCullPush, readonly)
SHARED_BUFFER(OpaquePushArray, OpaquePush, readonly)

struct Sources {
    PlainBladeArray blade;
    BladeArray packedBlade;
    PatchArray cell;
    FrameArray frame;
    VisibleArray visible;
    DrawArray draw;
    SpeciesArray species;
    GroundVertexArray groundVertex;
    GroundMaterialArray groundMaterial;
    ColliderTable collider;
    UpdatePushArray updatePush;
    WalkPushArray walkPush;
    RasterPushArray rasterPush;
    SubtreeArray subtree;
    VisiblePatchArray live;
    WalkLevelArray walkLevel;
    LargePartArray largePart;
    PyramidPushArray pyramidPush;
    ViewPushArray viewPush;
    CopyPushArray copyPush;
    GroundPushArray groundPush;
    MotionArray motion;
    BladePushArray bladePush;
    HostInstanceArray hostInstance;
    HostViewPushArray hostViewPush;
    PageChangeArray pageChange;
    PagePushArray pagePush;
    GroundClusterArray groundCluster;
    IndexedDrawArray indexedDraw;
    GroundCullPushArray groundCullPush;
    LargeTriangleArray largeTriangle;
    OpaqueWorkArray opaqueWork;
    OpaquePushArray opaquePush;
    HostLightArray hostLight;
    BladeShadowPushArray bladeShadowPush;
    LayersTableArray layersTable;
    LayersPushArray layersPush;
};
SHARED_BUFFER(SourcesArray, Sources, readonly)

layout(push_constant, scalar) uniform Block
{
    SourcesArray sources;
    UintArray target;
};

uint next = 0u;

void put(uint word)
{
    target.at[next++] = word;
}

void put(float x)
{
    put(floatBitsToUint(x));
}

void put(vec2 v)
{
    put(v.x);
    put(v.y);
}

void put(vec3 v)
{
    put(v.x);
    put(v.y);
    put(v.z);
}

void put(vec4 v)
{
    put(v.xyz);
    put(v.w);
}

void put(uvec2 reference)
{
    put(reference.x);
    put(reference.y);
}

void put(Cover cover)
{
    put(uvec2(cover.grass));
    put(cover.low);
    put(cover.cellsPerMetre);
    put(cover.countX);
    put(cover.countY);
    put(cover.countZ);
    put(cover.farthest);
    put(cover.undergrowth);
    put(cover.thatch);
    put(cover.sward);
    put(cover.thinned);
    put(cover.structure);
    put(cover.stepsPerMetre);
    for (uint i = 0u; i < heightSteps / 2u; ++i)
        put(cover.leaves[i]);
}

void put(FloorPlane plane)
{
    put(plane.middle);
    put(plane.reach);
    put(plane.along);
    put(plane.height);
    put(plane.halfSides);
    put(plane.cornerRadius);
}

void put(SunShadow shadow)
{
    put(uvec2(shadow.depths));
    put(shadow.across);
    put(shadow.down);
    put(shadow.depth);
    put(shadow.size);
    put(shadow.texel);
    put(shadow.epsilon);
    put(shadow.reserved);
}

void put(BladeShadow shadow)
{
    put(uvec2(shadow.map));
    put(shadow.across);
    put(shadow.down);
    put(shadow.depth);
    put(shadow.size);
    put(shadow.nearer);
}

void put(Gravity gravity)
{
    put(gravity.direction);
    put(gravity.strength);
    put(gravity.attractor);
    put(gravity.blend);
    put(gravity.forward);
}

void put(WindSource source)
{
    put(source.direction);
    put(source.strength);
    put(source.centre);
    put(source.size);
    put(source.speed);
    put(source.rate);
    put(source.turn);
    put(source.alignment);
    put(source.lift);
    put(source.kind);
    put(source.side);
    put(source.perSize);
}

void put(WindPhase phase)
{
    put(phase.shift);
    put(phase.cell);
    put(phase.fineShift);
    put(phase.fineCell);
    put(phase.angle);
    put(phase.turned);
}

void put(Collider collider)
{
    put(collider.from);
    put(collider.radius);
    put(collider.to);
    put(collider.reserved);
    put(collider.velocity);
    put(collider.reserved2);
}

void put(Environment environment)
{
    put(environment.gravity);
    put(environment.recovery);
    put(environment.colliderCount);
    put(environment.wind.counts);
    put(environment.wind.eddySize);
    put(environment.wind.eddySpeed);
    put(environment.wind.sum);
    put(environment.wind.eddyPhase);
    put(environment.wind.lattice.origin);
    put(environment.wind.lattice.x);
    put(environment.wind.lattice.y);
    put(environment.wind.lattice.z);
    for (uint i = 0u; i < maxWindSources; ++i)
        put(environment.wind.sources[i]);
    for (uint i = 0u; i < maxWindSources; ++i)
        put(environment.wind.phases[i]);
    put(uvec2(environment.colliders));
}

#include "layout_echo_frame.glsl"
#include "layout_echo_opaque.glsl"
#include "layout_echo_host_light.glsl"

void main()
{
    // The second element of each array, so that the stride is proven, too.
    const Blade blade = sources.at[0].blade.at[1];
    put(blade.root);
    put(blade.facing);
    put(blade.up);
    put(blade.stiffness);
    put(blade.height);
    put(blade.width);
    put(blade.exposure);
    put(blade.species);
    put(blade.tint);
    put(blade.clump);
    put(blade.hash);

    const PackedBlade bits = sources.at[0].packedBlade.at[1];
    put(bits.rootXY);
    put(bits.rootZUp);
    put(bits.shape);
    put(bits.look);
    const Patch cell = sources.at[0].cell.at[1];
    put(cell.boundsLow);
    put(cell.firstBlade);
    put(cell.boundsHigh);
    put(cell.bladeCount);
    put(cell.rootLow);
    put(cell.rootStep);
    put(cell.coneAxis);
    put(cell.coneCosine);
    put(cell.heightLow);
    put(cell.heightStep);
    put(cell.widthLow);
    put(cell.widthStep);
    put(cell.parent);
    put(cell.firstChild);
    put(cell.childCount);
    put(cell.level);
    put(cell.rankLow);
    put(cell.rankHigh);

    putFrame();

    const VisibleBlade visible = sources.at[0].visible.at[1];
    put(visible.blade);
    put(visible.patchIndex);
    put(visible.factors);
    put(visible.pixels);

    put(sources.at[0].draw.at[1].vertexCount);
    put(sources.at[0].draw.at[1].instanceCount);
    put(sources.at[0].draw.at[1].firstVertex);
    put(sources.at[0].draw.at[1].firstInstance);
    put(sources.at[0].draw.at[1].simulated);
    for (uint i = 0u; i < cullResultCount; ++i)
        put(sources.at[0].draw.at[1].cullResults[i]);

    const Species species = sources.at[0].species.at[1];
    put(species.rootColor);
    put(species.tipThreshold);
    put(species.tipColor);
    put(species.groundTint);
    put(species.colorVariation);
    put(species.translucency);
    put(species.gloss);
    put(species.dryness);
    put(species.shape);
    put(species.fold);

    const GroundVertex vertex = sources.at[0].groundVertex.at[1];
    put(vertex.position);
    put(vertex.normal);
    put(vertex.uv);
    put(vertex.color);

    const GroundMaterial material = sources.at[0].groundMaterial.at[1];
    put(material.baseColor);
    put(material.roughness);
    put(material.metallic);
    put(material.image);
    put(material.flags);

    put(sources.at[0].collider.at[1]);

    put(uvec2(sources.at[0].updatePush.at[1].cullView));
    put(uvec2(sources.at[0].updatePush.at[1].visiblePatches));
    put(uvec2(sources.at[0].updatePush.at[1].levels));
    put(uvec2(sources.at[0].updatePush.at[1].rounds));
    put(uvec2(sources.at[0].updatePush.at[1].nonEmptyPatches));
    put(uvec2(sources.at[0].updatePush.at[1].views));
    put(uvec2(sources.at[0].updatePush.at[1].before));
    put(uvec2(sources.at[0].updatePush.at[1].history));
    put(sources.at[0].updatePush.at[1].nonEmptyPatchCount);
    put(sources.at[0].updatePush.at[1].onlyUpdate);
    put(sources.at[0].updatePush.at[1].firstPatch);
    put(sources.at[0].updatePush.at[1].maxPatches);
    put(sources.at[0].updatePush.at[1].round);
    put(sources.at[0].updatePush.at[1].lateRound);
    put(sources.at[0].updatePush.at[1].viewCount);
    put(sources.at[0].updatePush.at[1].frame);

    put(uvec2(sources.at[0].walkPush.at[1].cullView));
    put(uvec2(sources.at[0].walkPush.at[1].subtrees));
    put(uvec2(sources.at[0].walkPush.at[1].queue));
    put(uvec2(sources.at[0].walkPush.at[1].visiblePatches));
    put(uvec2(sources.at[0].walkPush.at[1].levels));
    put(sources.at[0].walkPush.at[1].startCount);
    put(sources.at[0].walkPush.at[1].level);

    put(uvec2(sources.at[0].rasterPush.at[1].frame));
    put(uvec2(sources.at[0].rasterPush.at[1].cullView));
    put(uvec2(sources.at[0].rasterPush.at[1].visibility));
    put(uvec2(sources.at[0].rasterPush.at[1].rounds));
    put(uvec2(sources.at[0].rasterPush.at[1].large));
    put(uvec2(sources.at[0].rasterPush.at[1].largeCount));
    put(uvec2(sources.at[0].rasterPush.at[1].cut));
    put(uvec2(sources.at[0].rasterPush.at[1].nonEmptyPatches));
    put(uvec2(sources.at[0].rasterPush.at[1].firstNonEmptyPatches));
    put(uvec2(sources.at[0].rasterPush.at[1].history));
    put(uvec2(sources.at[0].rasterPush.at[1].cachePlaces));
    put(uvec2(sources.at[0].rasterPush.at[1].cachedSurfaces));
    put(uvec2(sources.at[0].rasterPush.at[1].tiles));
    put(sources.at[0].rasterPush.at[1].size);
    put(sources.at[0].rasterPush.at[1].isBgr);
    put(sources.at[0].rasterPush.at[1].round);
    put(sources.at[0].rasterPush.at[1].firstBlade);
    put(sources.at[0].rasterPush.at[1].instance);

    const Subtree subtree = sources.at[0].subtree.at[1];
    put(subtree.blades);
    put(subtree.widest);
    put(subtree.rankBelow);
    put(sources.at[0].live.at[1].patchIndex);
    put(sources.at[0].live.at[1].count);
    for (uint i = 0u; i < 3u; ++i)
        put(sources.at[0].walkLevel.at[1].groups[i]);
    put(sources.at[0].walkLevel.at[1].count);
    put(sources.at[0].largePart.at[1].v0);
    put(sources.at[0].largePart.at[1].width);
    put(sources.at[0].largePart.at[1].v1);
    put(sources.at[0].largePart.at[1].fold);
    put(sources.at[0].largePart.at[1].v2);
    put(sources.at[0].largePart.at[1].outline);
    put(sources.at[0].largePart.at[1].axis);
    put(sources.at[0].largePart.at[1].tipThreshold);
    put(sources.at[0].largePart.at[1].scale);
    put(sources.at[0].largePart.at[1].instance);
    put(sources.at[0].largePart.at[1].blade);
    put(sources.at[0].largePart.at[1].part);

    put(uvec2(sources.at[0].pyramidPush.at[1].frame));
    put(sources.at[0].pyramidPush.at[1].slack);
    put(sources.at[0].pyramidPush.at[1].reserved);
    put(uvec2(sources.at[0].viewPush.at[1].frame));
    put(uvec2(sources.at[0].copyPush.at[1].from));
    put(uvec2(sources.at[0].copyPush.at[1].to));
    put(sources.at[0].copyPush.at[1].count);
    put(sources.at[0].copyPush.at[1].reserved);
    put(uvec2(sources.at[0].groundPush.at[1].frame));
    put(uvec2(sources.at[0].groundPush.at[1].vertices));
    put(uvec2(sources.at[0].groundPush.at[1].materials));
    put(sources.at[0].groundPush.at[1].material);
    put(sources.at[0].groundPush.at[1].reserved);

    for (int column = 0; column < 4; ++column)
        put(sources.at[0].motion.at[1].clipBefore[column]);
    put(uvec2(sources.at[0].motion.at[1].statesBefore));
    put(sources.at[0].motion.at[1].moves);
    put(sources.at[0].motion.at[1].reserved);
    put(uvec2(sources.at[0].bladePush.at[1].frame));
    put(uvec2(sources.at[0].bladePush.at[1].motion));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.frame));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.cullView));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.visibility));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.rounds));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.large));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.largeCount));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.cut));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.nonEmptyPatches));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.firstNonEmptyPatches));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.history));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.cachePlaces));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.cachedSurfaces));
    put(uvec2(sources.at[0].hostInstance.at[1].raster.tiles));
    put(sources.at[0].hostInstance.at[1].raster.size);
    put(sources.at[0].hostInstance.at[1].raster.isBgr);
    put(sources.at[0].hostInstance.at[1].raster.round);
    put(sources.at[0].hostInstance.at[1].raster.firstBlade);
    put(sources.at[0].hostInstance.at[1].raster.instance);
    put(uvec2(sources.at[0].hostInstance.at[1].motion));
    put(uvec2(sources.at[0].hostViewPush.at[1].instances));
    put(uvec2(sources.at[0].hostViewPush.at[1].visibility));
    put(uvec2(sources.at[0].hostViewPush.at[1].motions));
    put(uvec2(sources.at[0].hostViewPush.at[1].tiles));
    put(sources.at[0].hostViewPush.at[1].size);
    put(sources.at[0].hostViewPush.at[1].instanceCount);
    put(sources.at[0].hostViewPush.at[1].slack);
    put(sources.at[0].hostViewPush.at[1].firstStored);

    put(sources.at[0].pageChange.at[1].page);
    put(sources.at[0].pageChange.at[1].place);
    put(sources.at[0].pageChange.at[1].edges);
    put(uvec2(sources.at[0].pagePush.at[1].changes));
    put(uvec2(sources.at[0].pagePush.at[1].pages));
    put(uvec2(sources.at[0].pagePush.at[1].states));
    put(uvec2(sources.at[0].pagePush.at[1].etas));
    put(uvec2(sources.at[0].pagePush.at[1].patches));
    put(uvec2(sources.at[0].pagePush.at[1].subtrees));
    put(uvec2(sources.at[0].pagePush.at[1].patchTimes));
    put(uvec2(sources.at[0].pagePush.at[1].patchCounts));
    put(uvec2(sources.at[0].pagePush.at[1].nonEmptyPatches));
    put(uvec2(sources.at[0].pagePush.at[1].firstNonEmptyPatches));
    put(sources.at[0].pagePush.at[1].nonEmptyPatchCount);
    put(sources.at[0].pagePush.at[1].bladeCount);
    put(sources.at[0].pagePush.at[1].settledAt);
    put(sources.at[0].pagePush.at[1].isOfStates);

    put(sources.at[0].groundCluster.at[1].low);
    put(sources.at[0].groundCluster.at[1].material);
    put(sources.at[0].groundCluster.at[1].high);
    put(sources.at[0].groundCluster.at[1].indexCount);

    put(sources.at[0].indexedDraw.at[1].indexCount);
    put(sources.at[0].indexedDraw.at[1].instanceCount);
    put(sources.at[0].indexedDraw.at[1].firstIndex);
    put(sources.at[0].indexedDraw.at[1].vertexOffset);
    put(sources.at[0].indexedDraw.at[1].firstInstance);

    put(uvec2(sources.at[0].groundCullPush.at[1].frame));
    put(uvec2(sources.at[0].groundCullPush.at[1].clusters));
    put(uvec2(sources.at[0].groundCullPush.at[1].draws));
    put(uvec2(sources.at[0].groundCullPush.at[1].seen));
    put(uvec2(sources.at[0].groundCullPush.at[1].drawCount));
    put(sources.at[0].groundCullPush.at[1].clusterCount);
    put(sources.at[0].groundCullPush.at[1].firstCluster);
    putOpaque();
    putHostLight();

    put(uvec2(sources.at[0].bladeShadowPush.at[1].visiblePatches));
    put(uvec2(sources.at[0].bladeShadowPush.at[1].levels));
    put(uvec2(sources.at[0].bladeShadowPush.at[1].visibility));
    put(sources.at[0].bladeShadowPush.at[1].size);
    put(sources.at[0].bladeShadowPush.at[1].firstBlade);
    put(sources.at[0].bladeShadowPush.at[1].reserved);

    put(uvec2(sources.at[0].layersTable.at[1].clusters));
    put(uvec2(sources.at[0].layersTable.at[1].indices));
    put(uvec2(sources.at[0].layersTable.at[1].vertices));
    put(uvec2(sources.at[0].layersTable.at[1].materials));
    put(uvec2(sources.at[0].layersTable.at[1].motion));
    put(uvec2(sources.at[0].layersTable.at[1].places));
    put(uvec2(sources.at[0].layersTable.at[1].placesBefore));
    put(uvec2(sources.at[0].layersTable.at[1].depths));
    put(uvec2(sources.at[0].layersTable.at[1].planes));
    put(uvec2(sources.at[0].layersTable.at[1].normals));
    put(uvec2(sources.at[0].layersTable.at[1].albedos));
    put(uvec2(sources.at[0].layersTable.at[1].surfaces));
    put(uvec2(sources.at[0].layersTable.at[1].blades));
    put(uvec2(sources.at[0].layersTable.at[1].patches));
    put(uvec2(sources.at[0].layersTable.at[1].flows));
    put(uvec2(sources.at[0].layersTable.at[1].flowsAhead));
    put(uvec2(sources.at[0].layersTable.at[1].shares));
    put(sources.at[0].layersTable.at[1].groundTriangles);
    put(sources.at[0].layersTable.at[1].elapsed);
    put(sources.at[0].layersTable.at[1].imageCount);
    put(sources.at[0].layersTable.at[1].reserved);
    put(uvec2(sources.at[0].layersPush.at[1].table));
    put(uvec2(sources.at[0].layersPush.at[1].raster));
    put(sources.at[0].layersPush.at[1].firstImage);
    put(sources.at[0].layersPush.at[1].reserved);
}
