#include "core/error.h"
#include "core/random.h"
#include "support/meshes.h"
#include "terrain/loading/repeated_ground.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sward::terrain {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// A triangle of area 1/2 at (x, 0, 0) as mesh; returns its index.
int triangleAt(GlbBuilder& builder, float x)
{
    return builder.mesh(
        {{"attributes", {{"POSITION", builder.floats({x, 0, 0, x + 1, 0, 0, x, 0, -1}, "VEC3")}}}});
}

double areaOf(const GroundMesh& mesh)
{
    return meshes::totalArea(mesh);
}

TEST(GltfVisibility, LeavesOutHiddenNodesAndAllBelowThem)
{
    // A chain of nodes, each with a triangle; what is hidden ends it.
    constexpr int length = 4;
    for (int hidden = 0; hidden <= length; ++hidden) {
        GlbBuilder builder;
        for (int i = 0; i < length; ++i) {
            nlohmann::json node = {{"mesh", triangleAt(builder, static_cast<float>(3 * i))},
                                   {"name", fmt::format("n{}", i)}};
            if (i + 1 < length)
                node["children"] = {i + 1};
            node["extensions"]["KHR_node_visibility"]["visible"] = i != hidden;
            builder.node(node);
        }
        builder.document["scenes"] = {{{"nodes", {0}}}};
        Diagnostics diagnostics;
        if (hidden == 0) {
            EXPECT_THROW(loadContent("a.glb", builder.glb(), {}, &diagnostics), Error);
            continue;
        }
        const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
        EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(hidden));
        if (hidden == length)
            EXPECT_THAT(diagnostics.warnings(), IsEmpty());
        else
            EXPECT_THAT(diagnostics.warnings().at(0), HasSubstr("KHR_node_visibility"));
    }
}

TEST(GltfVisibility, ShowsTheFinestLevelOfMsftLod)
{
    for (const bool coarseInScene : {false, true}) {
        GlbBuilder builder;
        builder.node({{"mesh", triangleAt(builder, 0)},
                      {"name", "fine"},
                      {"extensions", {{"MSFT_lod", {{"ids", {1, 2}}}}}}});
        builder.node({{"mesh", triangleAt(builder, 0.1f)}, {"name", "coarse"}});
        builder.node({{"mesh", triangleAt(builder, 0.2f)}, {"name", "coarsest"}});
        builder.document["scenes"] = {{{"nodes", {0}}}};
        if (coarseInScene)
            builder.document["scenes"] = {{{"nodes", {0, 1, 2}}}};
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
        EXPECT_EQ(mesh.triangles.size(), 1U);
        EXPECT_EQ(mesh.nodes[mesh.nodeOf[0]], "fine");
        EXPECT_EQ(diagnostics.warnings().size(), coarseInScene ? 1U : 0U);
    }
}

TEST(GltfVisibility, PlacesANodeOnceThatIsRootAndChild)
{
    // Any set of roots over a chain of three shows what its first root shows.
    for (unsigned roots = 1; roots < 8; ++roots) {
        GlbBuilder builder;
        for (int i = 0; i < 3; ++i) {
            nlohmann::json node = {{"translation", {10.0 * i, 0.0, 0.0}}};
            if (i < 2)
                node["children"] = {i + 1};
            else
                node["mesh"] = triangleAt(builder, 0);
            builder.node(node);
        }
        nlohmann::json named = nlohmann::json::array();
        for (int i = 2; i >= 0; --i)
            if ((roots >> i & 1U) != 0)
                named.push_back(i);
        builder.document["scenes"] = {{{"nodes", named}}};
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent("a.glb", builder.glb(), {}, &diagnostics);
        EXPECT_NEAR(areaOf(mesh), 0.5, 1e-9) << roots;
        // One for each that is named besides, and one for a first root that has a parent.
        const std::size_t lifted = (roots & 1U) == 0 ? 1 : 0;
        EXPECT_EQ(diagnostics.warnings().size(), named.size() - 1 + lifted) << roots;
        EXPECT_NEAR(worldPosition(mesh, mesh.triangles[0].x).x, 30.0, 1e-6) << roots;
    }
}

TEST(GltfExtensions, AreNamedIfUnknownAndRefusedIfRequired)
{
    for (const char* const name : {"ACME_ghosts", "KHR_of_tomorrow"}) {
        GlbBuilder builder = triangleGlb();
        builder.document["extensionsUsed"] = {name};
        Diagnostics diagnostics;
        loadContent("a.glb", builder.glb(), {}, &diagnostics);
        ASSERT_EQ(diagnostics.warnings().size(), 1U);
        EXPECT_THAT(diagnostics.warnings()[0], HasSubstr(name));
        builder.document["extensionsRequired"] = {name};
        try {
            loadContent("a.glb", builder.glb());
            FAIL() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        }
    }
    for (const char* const name : {"KHR_materials_sheen", "KHR_lights_punctual", "MSFT_lod",
                                   "KHR_texture_basisu", "EXT_mesh_gpu_instancing"}) {
        GlbBuilder builder = triangleGlb();
        builder.document["extensionsUsed"] = {name};
        Diagnostics diagnostics;
        loadContent("a.glb", builder.glb(), {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), IsEmpty()) << name;
    }
    GlbBuilder builder = triangleGlb();
    builder.document["extensionsUsed"] = {"EXT_mesh_primitive_restart"};
    EXPECT_THROW(loadContent("a.glb", builder.glb()), Error);
}

// An OBJ of level squares of side 2 with these names, at these x.
std::string squaresObj(const std::vector<std::pair<std::string, double>>& squares)
{
    std::string text;
    for (const auto& [name, x] : squares)
        text += fmt::format("o {}\nv {} 0 0\nv {} 0 2\nv {} 0 2\nv {} 0 0\nf -4 -3 -2 -1\n", name,
                            x, x, x + 2, x + 2);
    return text;
}

TEST(StandIns, AreCoarserLevelsOverTheFinest)
{
    const auto nodesOf = [](const std::vector<std::pair<std::string, double>>& squares,
                            const ImportSettings& settings = {}) {
        Diagnostics diagnostics;
        GroundMesh mesh = loadContent("a.obj", squaresObj(squares), settings, &diagnostics);
        removeColliders(mesh, settings, "a.obj", diagnostics);
        std::vector<std::string> names;
        for (const std::uint32_t node : mesh.nodeOf)
            if (names.empty() || names.back() != mesh.nodes[node])
                names.push_back(mesh.nodes[node]);
        return names;
    };
    using Names = std::vector<std::string>;
    // In any order, with any separator, and beside a name without a level.
    EXPECT_EQ(nodesOf({{"hill_LOD0", 0}, {"hill_LOD1", 0.1}, {"hill_LOD2", 0}}),
              Names{"hill_LOD0"});
    EXPECT_EQ(nodesOf({{"hill.lod2", 0}, {"hill-LOD1", 0.1}}), Names{"hill-LOD1"});
    EXPECT_EQ(nodesOf({{"hill_LOD1", 0}, {"hill", 0}}), Names{"hill"});
    EXPECT_EQ(nodesOf({{"a_LOD0", 0}, {"a_LOD1", 0}, {"b_LOD0", 9}, {"b_LOD1", 9}}),
              (Names{"a_LOD0", "b_LOD0"}));
    // What lies elsewhere, has no finer level or is something else stays.
    EXPECT_EQ(nodesOf({{"hill_LOD0", 0}, {"hill_LOD1", 5}}), (Names{"hill_LOD0", "hill_LOD1"}));
    EXPECT_EQ(nodesOf({{"hill_LOD1", 0}, {"dale_LOD1", 0}}), (Names{"hill_LOD1", "dale_LOD1"}));
    EXPECT_EQ(nodesOf({{"explode1", 0}, {"explode0", 0}}), (Names{"explode1", "explode0"}));
    // Colliders are never seen.
    EXPECT_EQ(nodesOf({{"hill", 0}, {"hill-colonly", 0.3}, {"UCX_hill_01", 0.2}}), Names{"hill"});
    // Who names nodes decides.
    ImportSettings chosen;
    chosen.bearingNodes = {"hill_LOD1"};
    EXPECT_EQ(nodesOf({{"hill_LOD0", 0}, {"hill_LOD1", 0}}, chosen).size(), 2U);
}

TEST(Coincident, TrianglesCountOnceInAnyOrderOfTheirCorners)
{
    for (std::uint32_t trial = 0; trial < 30; ++trial) {
        GroundMesh mesh = meshes::hills(20.0, 6);
        const GroundMesh whole = mesh;
        // Repeat some triangles on vertices of their own, turned about; and some with other fronts.
        std::size_t repeated = 0;
        std::size_t flipped = 0;
        for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
            const double chance = uniform(7, trial, static_cast<std::uint32_t>(t));
            if (chance > 0.4)
                continue;
            GroundMesh one = whole;
            glm::uvec3 corners = whole.triangles[t];
            for (std::uint32_t turn = 0; turn < t % 3; ++turn)
                corners = {corners.y, corners.z, corners.x};
            if (chance < 0.1)
                std::swap(corners.x, corners.y);
            (chance < 0.1 ? flipped : repeated) += 1;
            one.triangles = {corners};
            one.materialOf = {0};
            one.nodeOf = {0};
            one.bears = {1};
            append(mesh, one);
        }
        Diagnostics diagnostics;
        removeCoincident(mesh, diagnostics);
        validate(mesh, "mesh");
        EXPECT_EQ(mesh.triangles.size(), whole.triangles.size() + flipped);
        ASSERT_EQ(diagnostics.warnings().size(), 1U);
        EXPECT_THAT(diagnostics.warnings()[0], HasSubstr(fmt::format("{} triangles", repeated)));
        for (std::size_t t = 0; t < whole.triangles.size(); ++t)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                EXPECT_EQ(mesh.positions[mesh.triangles[t][corner]],
                          whole.positions[whole.triangles[t][corner]]);
    }
}

TEST(Coincident, TrianglesThatBearNothingStay)
{
    GroundMesh mesh = meshes::square(2.0);
    GroundMesh occluder = mesh;
    std::fill(occluder.bears.begin(), occluder.bears.end(), std::uint8_t(0));
    append(mesh, occluder);
    Diagnostics diagnostics;
    removeCoincident(mesh, diagnostics);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(RemoveTriangles, MovesGapsWithTheirTriangles)
{
    GroundMesh mesh = meshes::grid(2, 2.0);
    mesh.attributes.addGap("COLOR_0", 2, 5, "a");
    mesh.attributes.addGap("COLOR_0", 6, 7, "b");
    removeTriangles(mesh, {true, false, false, true, false, false, true, false});
    ASSERT_EQ(mesh.attributes.gaps.size(), 1U);
    EXPECT_EQ(mesh.attributes.gaps[0].first, 1U);
    EXPECT_EQ(mesh.attributes.gaps[0].end, 3U);
    validate(mesh, "mesh");
}

} // namespace
} // namespace sward::terrain
