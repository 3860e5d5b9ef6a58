// Sends every struct shared by both languages through a shader.

#include "core/embedded.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "shaders/shared/layers/layers_table.h"
#include "shaders/shared/opaque.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> renderTestShaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

/// Numbers the scalars of structs 1, 2, 3, … in the order of their members. Each number is a float
/// bit pattern that is not a denormal; references take two.
class Counter {
public:
    void fill(float& x) { x = ++count_; }
    void fill(std::uint32_t& x) { x = word(++count_); }
    void fill(std::uint64_t& x)
    {
        const std::uint64_t low = word(++count_);
        x = low | std::uint64_t(word(++count_)) << 32;
    }
    void fill(glm::vec2& v) { fillAll(v.x, v.y); }
    void fill(glm::uvec2& v) { fillAll(v.x, v.y); }
    void fill(glm::vec3& v) { fillAll(v.x, v.y, v.z); }
    void fill(glm::vec4& v) { fillAll(v.x, v.y, v.z, v.w); }
    void fill(glm::mat4& m) { fillAll(m[0], m[1], m[2], m[3]); }
    void fill(shared::Gravity& g)
    {
        fillAll(g.direction, g.strength, g.attractor, g.blend, g.forward);
    }
    void fill(shared::Wind& w)
    {
        fillAll(w.counts, w.eddySize, w.eddySpeed, w.sum, w.eddyPhase, w.lattice.origin,
                w.lattice.x, w.lattice.y, w.lattice.z, w.sources, w.phases);
    }
    void fill(shared::WindSource& s)
    {
        fillAll(s.direction, s.strength, s.centre, s.size, s.speed, s.rate, s.turn, s.alignment,
                s.lift, s.kind, s.side, s.perSize);
    }
    void fill(shared::WindPhase& p)
    {
        fillAll(p.shift, p.cell, p.fineShift, p.fineCell, p.angle, p.turned);
    }
    void fill(shared::Collider& c)
    {
        fillAll(c.from, c.radius, c.to, c.reserved, c.velocity, c.reserved2);
    }
    void fill(shared::Environment& n)
    {
        fillAll(n.gravity, n.recovery, n.colliderCount, n.wind, n.colliders.address);
    }
    void fill(shared::RasterPush& r)
    {
        fillAll(r.frame, r.cullView, r.visibility, r.rounds, r.large, r.largeCount, r.cut,
                r.nonEmptyPatches, r.firstNonEmptyPatches, r.history, r.cachePlaces,
                r.cachedSurfaces, r.tiles, r.size, r.isBgr, r.round, r.firstBlade, r.instance);
    }
    void fill(shared::Eyepoint& e)
    {
        fillAll(e.planes, e.eye, e.drawDistance, e.pixelsPerUnit, e.lodThreshold, e.lodWidth,
                e.minWidth, e.maxLeafArea, e.maxEdgeOn, e.samples, e.buckets, e.bucketDistance,
                e.cullMask);
    }
    void fill(shared::LevelSteps& s) { fillAll(s.distance, s.segments, s.count); }
    void fill(shared::UpdateRate& p) { fillAll(p.everyFrame, p.everyThird, p.longest, p.frame); }
    void fill(shared::Cover& c)
    {
        fillAll(c.grass.address, c.low, c.cellsPerMetre, c.countX, c.countY, c.countZ, c.farthest,
                c.undergrowth, c.thatch, c.sward, c.thinned, c.structure, c.stepsPerMetre,
                c.leaves);
    }
    void fill(shared::SunShadow& s)
    {
        fillAll(s.depths.address, s.across, s.down, s.depth, s.size, s.texel, s.epsilon,
                s.reserved);
    }
    void fill(shared::BladeShadow& s)
    {
        fillAll(s.map.address, s.across, s.down, s.depth, s.size, s.nearer);
    }
    void fill(shared::FloorPlane& p)
    {
        fillAll(p.middle, p.reach, p.along, p.height, p.halfSides, p.cornerRadius);
    }
    void fill(shared::Cascade& c) { fillAll(c.across, c.down, c.depth, c.width); }
    void fill(shared::Lamp& l)
    {
        fillAll(l.position, l.perRange, l.color, l.nearest, l.direction, l.perCone, l.coneEdge,
                l.reserved);
    }
    template <typename T, std::size_t n>
    void fill(T (&elements)[n])
    {
        for (T& element : elements)
            fill(element);
    }
    template <typename... Members>
    void fillAll(Members&... members)
    {
        (fill(members), ...);
    }

    static std::uint32_t word(float x) { return std::bit_cast<std::uint32_t>(x); }
    std::size_t count() const { return static_cast<std::size_t>(count_); }

private:
    float count_ = 0.0f;
};

/// One filled value of every shared struct, in the order in which the shader echoes them.
struct Values {
    shared::Blade blade;
    shared::PackedBlade packedBlade;
    shared::Patch cell;
    shared::Frame frame;
    shared::VisibleBlade visible;
    shared::DrawArguments draw;
    shared::Species species;
    shared::GroundVertex groundVertex;
    shared::GroundMaterial groundMaterial;
    shared::Collider collider;
    shared::UpdatePush updatePush;
    shared::WalkPush walkPush;
    shared::RasterPush rasterPush;
    shared::Subtree subtree;
    shared::VisiblePatch live;
    shared::WalkLevel walkLevel;
    shared::LargePart largePart;
    shared::PyramidPush pyramidPush;
    shared::ViewPush viewPush;
    shared::CopyPush copyPush;
    shared::GroundPush groundPush;
    shared::Motion motion;
    shared::BladePush bladePush;
    shared::HostInstance hostInstance;
    shared::HostViewPush hostViewPush;
    shared::PageChange pageChange;
    shared::PagePush pagePush;
    shared::GroundCluster groundCluster;
    shared::IndexedDraw indexedDraw;
    shared::GroundCullPush groundCullPush;
    shared::LargeTriangle largeTriangle;
    shared::OpaqueWork opaqueWork;
    shared::OpaquePush opaquePush;
    shared::HostLight hostLight;
    shared::BladeShadowPush bladeShadowPush;
    shared::LayersTable layersTable;
    shared::LayersPush layersPush;
};

std::size_t fillValues(Values& v)
{
    Counter n;
    n.fillAll(v.blade.root, v.blade.facing, v.blade.up, v.blade.stiffness, v.blade.height,
              v.blade.width, v.blade.exposure, v.blade.species, v.blade.tint, v.blade.clump,
              v.blade.hash);
    n.fillAll(v.packedBlade.rootXY, v.packedBlade.rootZUp, v.packedBlade.shape, v.packedBlade.look);
    n.fillAll(v.cell.boundsLow, v.cell.firstBlade, v.cell.boundsHigh, v.cell.bladeCount,
              v.cell.rootLow, v.cell.rootStep, v.cell.coneAxis, v.cell.coneCosine, v.cell.heightLow,
              v.cell.heightStep, v.cell.widthLow, v.cell.widthStep, v.cell.parent,
              v.cell.firstChild, v.cell.childCount, v.cell.level, v.cell.rankLow, v.cell.rankHigh);
    shared::Frame& f = v.frame;
    n.fillAll(f.blades, f.states, f.etas, f.patches, f.species, f.visible, f.draw, f.patchTimes,
              f.patchCounts, f.cullResults, f.pages, f.hostLight, f.pyramid.depths, f.pyramid.size,
              f.pyramid.first, f.pyramid.levels, f.viewProjection, f.rays, f.depthOfEye, f.view,
              f.tick, f.environment, f.patchCount, f.bladeCount, f.visibleCapacity,
              f.maxTessellation, f.sunDirection, f.exposure, f.sunColor, f.debugMode, f.skyColor,
              f.fogDensity, f.groundColor, f.skyUp, f.fixedTessellation, f.clouds, f.levelSteps,
              f.updateRate, f.cover, f.shadow, f.bladeShadow, f.fogFalloff, f.lowSun, f.floorPlane,
              f.reserved);
    n.fillAll(v.visible.blade, v.visible.patchIndex, v.visible.factors, v.visible.pixels);
    n.fillAll(v.draw.vertexCount, v.draw.instanceCount, v.draw.firstVertex, v.draw.firstInstance,
              v.draw.simulated, v.draw.cullResults);
    n.fillAll(v.species.rootColor, v.species.tipThreshold, v.species.tipColor, v.species.groundTint,
              v.species.colorVariation, v.species.translucency, v.species.gloss, v.species.dryness,
              v.species.shape, v.species.fold);
    n.fillAll(v.groundVertex.position, v.groundVertex.normal, v.groundVertex.uv,
              v.groundVertex.color);
    n.fillAll(v.groundMaterial.baseColor, v.groundMaterial.roughness, v.groundMaterial.metallic,
              v.groundMaterial.image, v.groundMaterial.flags);
    n.fillAll(v.collider);
    shared::UpdatePush& u = v.updatePush;
    n.fillAll(u.cullView, u.visiblePatches, u.levels, u.rounds, u.nonEmptyPatches, u.views,
              u.before, u.history, u.nonEmptyPatchCount, u.onlyUpdate, u.firstPatch, u.maxPatches,
              u.round, u.lateRound, u.viewCount, u.frame);
    shared::WalkPush& w = v.walkPush;
    n.fillAll(w.cullView, w.subtrees, w.queue, w.visiblePatches, w.levels, w.startCount, w.level);
    n.fill(v.rasterPush);
    n.fillAll(v.subtree.blades, v.subtree.widest, v.subtree.rankBelow);
    n.fillAll(v.live.patchIndex, v.live.count);
    n.fillAll(v.walkLevel.groups, v.walkLevel.count);
    shared::LargePart& l = v.largePart;
    n.fillAll(l.v0, l.width, l.v1, l.fold, l.v2, l.outline, l.axis, l.tipThreshold, l.scale,
              l.instance, l.blade, l.part);
    n.fillAll(v.pyramidPush.frame, v.pyramidPush.slack, v.pyramidPush.reserved);
    n.fillAll(v.viewPush.frame);
    n.fillAll(v.copyPush.from, v.copyPush.to, v.copyPush.count, v.copyPush.reserved);
    n.fillAll(v.groundPush.frame, v.groundPush.vertices, v.groundPush.materials,
              v.groundPush.material, v.groundPush.reserved);
    n.fillAll(v.motion.clipBefore, v.motion.statesBefore, v.motion.moves, v.motion.reserved);
    n.fillAll(v.bladePush.frame, v.bladePush.motion);
    n.fillAll(v.hostInstance.raster, v.hostInstance.motion);
    shared::HostViewPush& h = v.hostViewPush;
    n.fillAll(h.instances, h.visibility, h.motions, h.tiles, h.size, h.instanceCount, h.slack,
              h.firstStored);
    n.fillAll(v.pageChange.page, v.pageChange.place, v.pageChange.edges);
    shared::PagePush& p = v.pagePush;
    n.fillAll(p.changes, p.pages, p.states, p.etas, p.patches, p.subtrees, p.patchTimes,
              p.patchCounts, p.nonEmptyPatches, p.firstNonEmptyPatches, p.nonEmptyPatchCount,
              p.bladeCount, p.settledAt, p.isOfStates);
    n.fillAll(v.groundCluster.low, v.groundCluster.material, v.groundCluster.high,
              v.groundCluster.indexCount);
    n.fillAll(v.indexedDraw.indexCount, v.indexedDraw.instanceCount, v.indexedDraw.firstIndex,
              v.indexedDraw.vertexOffset, v.indexedDraw.firstInstance);
    shared::GroundCullPush& g = v.groundCullPush;
    n.fillAll(g.frame, g.clusters, g.draws, g.seen, g.drawCount, g.clusterCount, g.firstCluster);
    n.fillAll(v.largeTriangle.triangle, v.largeTriangle.firstTile, v.largeTriangle.tile,
              v.largeTriangle.columns);
    n.fillAll(v.opaqueWork.middle.groups, v.opaqueWork.middle.count, v.opaqueWork.tiles.groups,
              v.opaqueWork.tiles.count, v.opaqueWork.tilesAsked, v.opaqueWork.trianglesAsked);
    shared::OpaquePush& s = v.opaquePush;
    n.fillAll(s.frame, s.visibility, s.clusters, s.indices, s.vertices, s.materials, s.work,
              s.middle, s.large, s.size, s.clusterCount, s.triangleCount, s.firstImage,
              s.imageCount);
    shared::HostLight& light = v.hostLight;
    n.fillAll(light.ambient, light.above, light.cascades, light.lamps, light.cascadeCount,
              light.lampCount, light.hasAmbient, light.nearer, light.lift);
    shared::BladeShadowPush& b = v.bladeShadowPush;
    n.fillAll(b.visiblePatches, b.levels, b.visibility, b.size, b.firstBlade, b.reserved);
    shared::LayersTable& t = v.layersTable;
    n.fillAll(t.clusters, t.indices, t.vertices, t.materials, t.motion, t.places, t.placesBefore,
              t.depths, t.planes, t.normals, t.albedos, t.surfaces, t.blades, t.patches, t.flows,
              t.flowsAhead, t.shares, t.groundTriangles, t.elapsed, t.imageCount, t.reserved);
    n.fillAll(v.layersPush.table, v.layersPush.raster, v.layersPush.firstImage,
              v.layersPush.reserved);
    return n.count();
}

using LayoutTest = test::GpuTest;

/// The value as the second of two elements of a buffer.
template <typename T>
gpu::Buffer secondElement(const gpu::DeviceContext& context, const T& value)
{
    gpu::Buffer buffer(context, {.name = "struct",
                                 .bytes = 2 * sizeof(T),
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                 .memory = gpu::MemoryUse::upload});
    std::memset(buffer.mapped().data(), 0, sizeof(T));
    std::memcpy(buffer.mapped().data() + sizeof(T), &value, sizeof(T));
    return buffer;
}

TEST_F(LayoutTest, EverySharedStructMeansTheSameToBothLanguages)
{
    Values values = {};
    const std::size_t words = fillValues(values);

    // The frame is reached as element 0 everywhere, so here, too.
    std::array<gpu::Buffer, 37> buffers = {secondElement(context(), values.blade),
                                           secondElement(context(), values.packedBlade),
                                           secondElement(context(), values.cell),
                                           secondElement(context(), values.frame),
                                           secondElement(context(), values.visible),
                                           secondElement(context(), values.draw),
                                           secondElement(context(), values.species),
                                           secondElement(context(), values.groundVertex),
                                           secondElement(context(), values.groundMaterial),
                                           secondElement(context(), values.collider),
                                           secondElement(context(), values.updatePush),
                                           secondElement(context(), values.walkPush),
                                           secondElement(context(), values.rasterPush),
                                           secondElement(context(), values.subtree),
                                           secondElement(context(), values.live),
                                           secondElement(context(), values.walkLevel),
                                           secondElement(context(), values.largePart),
                                           secondElement(context(), values.pyramidPush),
                                           secondElement(context(), values.viewPush),
                                           secondElement(context(), values.copyPush),
                                           secondElement(context(), values.groundPush),
                                           secondElement(context(), values.motion),
                                           secondElement(context(), values.bladePush),
                                           secondElement(context(), values.hostInstance),
                                           secondElement(context(), values.hostViewPush),
                                           secondElement(context(), values.pageChange),
                                           secondElement(context(), values.pagePush),
                                           secondElement(context(), values.groundCluster),
                                           secondElement(context(), values.indexedDraw),
                                           secondElement(context(), values.groundCullPush),
                                           secondElement(context(), values.largeTriangle),
                                           secondElement(context(), values.opaqueWork),
                                           secondElement(context(), values.opaquePush),
                                           secondElement(context(), values.hostLight),
                                           secondElement(context(), values.bladeShadowPush),
                                           secondElement(context(), values.layersTable),
                                           secondElement(context(), values.layersPush)};
    constexpr std::size_t frame = 3;
    std::memcpy(buffers[frame].mapped().data(), &values.frame, sizeof values.frame);

    const gpu::Buffer sources(context(), {.name = "sources",
                                          .bytes = buffers.size() * sizeof(std::uint64_t),
                                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                          .memory = gpu::MemoryUse::upload});
    for (std::size_t i = 0; i < buffers.size(); ++i)
        sources.mappedAs<std::uint64_t>()[i] = buffers[i].address();
    const gpu::Buffer target(context(), {.name = "target",
                                         .bytes = (words + 64) * sizeof(std::uint32_t),
                                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                  VK_BUFFER_USAGE_TRANSFER_SRC_BIT});

    const gpu::ShaderLibrary shaders(embedded::renderTestShaders());
    const gpu::ComputePipeline pipeline(context(), shaders,
                                        {.name = "layout echo",
                                         .shader = "layout_echo.comp",
                                         .pushConstantBytes = 16,
                                         .setLayouts = {},
                                         .constants = {}});
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
        pipeline.bind(commands);
        pipeline.push(commands, std::array{sources.address(), target.address()});
        vkCmdDispatch(commands, 1, 1, 1);
    });

    const auto echoed = gpu::readBufferAs<std::uint32_t>(context(), target);
    for (std::size_t i = 0; i < words; ++i)
        ASSERT_EQ(std::bit_cast<float>(echoed[i]), static_cast<float>(i + 1)) << "scalar " << i;
}

} // namespace
} // namespace sward::render
