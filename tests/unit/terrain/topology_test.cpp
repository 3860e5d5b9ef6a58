#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/topology/topology.h"
#include "terrain/topology/weld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sward::terrain {
namespace {

using testing::Each;
using testing::ElementsAre;

/// Mirrored halves of a mesh meet at +0 and -0.
TEST(Weld, MakesOneVertexOfBothZeros)
{
    std::vector<glm::vec3> positions;
    for (int i = 1; i <= 100; ++i)
        for (const float zero : {0.0f, -0.0f}) {
            positions.push_back({zero, float(i), 1.0f});
            positions.push_back({float(i), zero, 2.0f});
            positions.push_back({float(i), 3.0f, zero});
        }
    std::uint32_t count = 0;
    const std::vector<std::uint32_t> numbers = weld(positions, count);
    EXPECT_EQ(count, 300U);
    for (std::size_t i = 0; i < positions.size(); i += 6)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(numbers[i + k], numbers[i + 3 + k]);
}

TEST(Topology, KnowsACubeByItsTwelveCreases)
{
    const Topology topology = analyse(meshes::cube());
    EXPECT_EQ(topology.weldedVertices, 8U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.borderEdgeCount, 0U);
    EXPECT_EQ(topology.creaseEdgeCount, 12U);
    EXPECT_EQ(topology.nonManifoldEdgeCount, 0U);
    EXPECT_EQ(topology.nonManifoldVertexCount, 0U);
    EXPECT_EQ(topology.degenerateTriangles + topology.duplicateTriangles, 0U);
}

TEST(Topology, FindsNoCreaseBelowTheAngle)
{
    EXPECT_EQ(analyse(meshes::cube(), 1.6).creaseEdgeCount, 0U);
    EXPECT_EQ(analyse(meshes::sphere(64)).creaseEdgeCount, 0U);
    EXPECT_EQ(analyse(meshes::sphere(64), 0.05).borderEdgeCount, 0U);
    EXPECT_GT(analyse(meshes::sphere(64), 0.05).creaseEdgeCount, 1000U);
}

TEST(Topology, CountsTheBorderOfAnOpenGrid)
{
    const GroundMesh grid =
        heightfield({glm::dvec2(3.0, 5.0), glm::uvec2(3, 5)}, [](double, double) { return 0.0; });
    const Topology topology = analyse(grid);
    EXPECT_EQ(topology.borderEdgeCount, 16U);
    EXPECT_EQ(topology.components, 1U);
    std::size_t flagged = 0;
    for (const std::uint8_t bits : topology.borderEdges)
        flagged += static_cast<std::size_t>(__builtin_popcount(bits));
    EXPECT_EQ(flagged, 16U);
}

TEST(Topology, MarksTheBorderEdgesOfATriangle)
{
    // The square's diagonal is its inner edge: corner 2 to 1 of one triangle, 1 to 2 of the other.
    const Topology topology = analyse(meshes::square());
    EXPECT_THAT(topology.borderEdges, ElementsAre(0b101, 0b110));
}

TEST(Topology, JoinsVerticesOfEqualPositionAlone)
{
    // Two squares that share an edge by position but not by index, one with a negative zero.
    const GroundMesh mesh =
        meshes::soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, -0.0, 0}, {-0.0, 0, 1}, {1, 0, 1}},
                     {{0, 1, 2}, {3, 4, 5}});
    const Topology topology = analyse(mesh);
    EXPECT_EQ(topology.weldedVertices, 4U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.borderEdgeCount, 4U);
}

TEST(Topology, KeepsABookTogetherAtItsSpine)
{
    const Topology topology = analyse(meshes::book());
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.nonManifoldEdgeCount, 1U);
    EXPECT_EQ(topology.nonManifoldVertexCount, 0U) << "all pages share the spine: one fan";
    EXPECT_EQ(topology.borderEdgeCount, 9U) << "the spine is no border";
}

TEST(Topology, ClosesAMoebiusStripAtItsSeam)
{
    const Topology topology = analyse(meshes::moebius(32));
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.borderEdgeCount, 64U);
    EXPECT_EQ(topology.nonManifoldEdgeCount, 0U);
    EXPECT_EQ(topology.nonManifoldVertexCount, 0U);
    EXPECT_EQ(topology.creaseEdgeCount, 1U) << "where its fronts disagree";
}

TEST(Topology, NumbersPiecesByTheirFirstTriangle)
{
    const Topology topology = analyse(meshes::boxAbovePlane());
    EXPECT_EQ(topology.components, 2U);
    for (std::size_t i = 0; i < topology.componentOf.size(); ++i)
        EXPECT_EQ(topology.componentOf[i], i < 2 ? 0U : 1U);
}

TEST(Topology, FindsFansThatTouchInAPoint)
{
    const Topology topology = analyse(meshes::soup(
        {{0, 0, 0}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}}, {{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(topology.nonManifoldVertexCount, 1U);
    EXPECT_EQ(topology.components, 2U);
    EXPECT_EQ(topology.borderEdgeCount, 6U);

    // A closed fan and a loose triangle at its middle.
    const Topology closed = analyse(meshes::soup(
        {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, -1}},
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {0, 5, 6}}));
    EXPECT_EQ(closed.nonManifoldVertexCount, 1U);
    EXPECT_EQ(closed.borderEdgeCount, 7U);
}

TEST(Topology, CountsATriangleThatIsThereTwiceOnce)
{
    // The second time as it is, the third time turned round.
    const GroundMesh mesh = meshes::soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}},
                                         {{0, 1, 2}, {2, 1, 3}, {1, 2, 0}, {0, 2, 1}});
    const Topology topology = analyse(mesh);
    EXPECT_EQ(topology.duplicateTriangles, 2U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.borderEdgeCount, 4U);
    EXPECT_EQ(topology.nonManifoldEdgeCount, 0U);
    // Their borders equal those of the first, for any first corner: edge 1–2 is inside.
    EXPECT_EQ(topology.borderEdges[2], 0b110);
    EXPECT_EQ(topology.borderEdges[3], 0b101);
}

TEST(Topology, CountsTrianglesWithoutAnArea)
{
    // One with two equal corners, one whose corners lie on a line.
    const GroundMesh mesh = meshes::soup({{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, 1, 2}, {0, 0, 1}, {0, 3, 1}});
    const Topology topology = analyse(mesh);
    EXPECT_EQ(topology.degenerateTriangles, 2U);
    EXPECT_EQ(topology.components, 1U);
}

TEST(Topology, KeepsTheTwoSheetsOfALeafApart)
{
    // A tenth of a millimetre between them, fronts outside.
    GroundMesh leaf = meshes::square(0.1);
    GroundMesh lower = meshes::square(0.1, -1e-4);
    for (glm::uvec3& t : lower.triangles)
        std::swap(t.y, t.z);
    append(leaf, lower);
    const Topology topology = analyse(leaf);
    EXPECT_EQ(topology.components, 2U);
    EXPECT_EQ(topology.borderEdgeCount, 8U);
    EXPECT_EQ(topology.duplicateTriangles, 0U);
}

TEST(Topology, IsTheSameFarFromTheOrigin)
{
    for (const GroundMesh& mesh : {meshes::cube(), meshes::moebius(32), meshes::book()}) {
        const Topology near = analyse(mesh);
        const Topology far = analyse(meshes::moved(mesh, {1e6, -1e6, 1e6}));
        EXPECT_EQ(near.components, far.components);
        EXPECT_EQ(near.borderEdgeCount, far.borderEdgeCount);
        EXPECT_EQ(near.creaseEdgeCount, far.creaseEdgeCount);
        EXPECT_EQ(near.nonManifoldEdgeCount, far.nonManifoldEdgeCount);
    }
}

TEST(Topology, TellsBrokenEdgesFromSharpOnes)
{
    const auto broken = [](const GroundMesh& mesh) {
        std::size_t count = 0;
        for (const std::uint8_t bits : analyse(mesh).brokenEdges)
            count += static_cast<std::size_t>(__builtin_popcount(bits));
        return count;
    };
    EXPECT_EQ(broken(meshes::cube()), 0U);
    EXPECT_EQ(broken(meshes::book()), 3U) << "the spine, from each page";
    EXPECT_EQ(broken(meshes::moebius(32)), 2U) << "the seam, from both sides";
}

TEST(Topology, DoesNotDependOnTheOrderOfTriangles)
{
    GroundMesh mesh = meshes::book();
    append(mesh, meshes::moebius(16));
    append(mesh, meshes::moved(meshes::cube(), {5, 0, 0}));
    GroundMesh backward = mesh;
    std::reverse(backward.triangles.begin(), backward.triangles.end());
    const Topology a = analyse(mesh);
    const Topology b = analyse(backward);
    EXPECT_EQ(a.borderEdgeCount, b.borderEdgeCount);
    EXPECT_EQ(a.creaseEdgeCount, b.creaseEdgeCount);
    EXPECT_EQ(a.nonManifoldEdgeCount, b.nonManifoldEdgeCount);
    EXPECT_EQ(a.nonManifoldVertexCount, b.nonManifoldVertexCount);
    EXPECT_EQ(a.components, b.components);
}

} // namespace
} // namespace sward::terrain
