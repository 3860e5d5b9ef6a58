#include "core/random.h"
#include "support/meshes.h"
#include "terrain/topology/surface_features.h"
#include "terrain/topology/topology.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sward::terrain {
namespace {

constexpr int cells = 12; // of a square ground along a side

double seamChance(std::uint32_t trial, std::uint32_t number)
{
    return uniform(97, trial, number);
}

// Height of the ground at a corner of its cells.
float heightAt(int i, int j)
{
    return static_cast<float>(
        std::floor(64.0 * seamChance(0, static_cast<std::uint32_t>(97 * i + j))) / 64.0);
}

// Appends a rectangle of cells as a mesh whose coordinates begin at its first corner.
int addTile(GlbBuilder& builder, int i0, int j0, int i1, int j1, double step, bool quantised)
{
    std::vector<float> floats;
    std::vector<std::uint16_t> shorts;
    std::vector<std::uint16_t> indices;
    const int width = i1 - i0 + 1;
    for (int j = j0; j <= j1; ++j)
        for (int i = i0; i <= i1; ++i)
            for (const double number : {step * (i - i0), double(heightAt(i, j)), step * (j - j0)}) {
                floats.push_back(static_cast<float>(number));
                shorts.push_back(static_cast<std::uint16_t>(std::lround(64.0 * number)));
            }
    for (int j = 0; j < j1 - j0; ++j)
        for (int i = 0; i < i1 - i0; ++i) {
            const auto a = static_cast<std::uint16_t>(j * width + i);
            const auto b = static_cast<std::uint16_t>(a + width);
            for (const int corner : {int(a), int(b), a + 1, a + 1, int(b), b + 1})
                indices.push_back(static_cast<std::uint16_t>(corner));
        }
    const int positions =
        quantised ? builder.shorts(shorts, "VEC3") : builder.floats(floats, "VEC3");
    return builder.mesh({{"attributes", {{"POSITION", positions}}},
                         {"indices", builder.shorts(indices, "SCALAR")}});
}

// The ground in tiles of random widths, placed in single precision.
GroundMesh tiled(std::uint32_t trial, bool quantised)
{
    GlbBuilder builder;
    const double step = quantised ? 2.7 : 0.1 + 3.0 * seamChance(trial, 1);
    const double offset = 1000.0 * seamChance(trial, 2);
    std::vector<int> cuts = {0};
    while (cuts.back() < cells)
        cuts.push_back(std::min(
            cells, cuts.back() + 1 +
                       int(5.0 * seamChance(trial, 3 + static_cast<std::uint32_t>(cuts.size())))));
    for (std::size_t a = 0; a + 1 < cuts.size(); ++a)
        for (std::size_t b = 0; b + 1 < cuts.size(); ++b) {
            const int mesh =
                addTile(builder, cuts[a], cuts[b], cuts[a + 1], cuts[b + 1], step, quantised);
            nlohmann::json node = {{"mesh", mesh},
                                   {"translation",
                                    {static_cast<float>(offset + step * cuts[a]), 0.0,
                                     static_cast<float>(step * cuts[b] - offset)}}};
            if (quantised)
                node["scale"] = {1.0 / 64.0, 1.0 / 64.0, 1.0 / 64.0};
            builder.node(node);
        }
    if (quantised)
        builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    return loadContent("a.glb", builder.glb());
}

TEST(Seams, OfAnySplitIntoTilesAreNoBorders)
{
    for (std::uint32_t trial = 0; trial < 24; ++trial) {
        const GroundMesh mesh = tiled(trial, trial % 2 == 1);
        EXPECT_GT(mesh.precision, 0.0);
        const Topology topology = analyse(mesh);
        EXPECT_EQ(topology.components, 1U) << trial;
        EXPECT_EQ(topology.borderEdgeCount, 4U * cells) << trial;
        EXPECT_EQ(topology.weldedVertices, (cells + 1U) * (cells + 1U)) << trial;
        FeatureChoice choice;
        choice.borders = true;
        EXPECT_EQ(findFeatures(mesh, topology, choice).borders.size(), 4U * cells);
    }
}

// Two level strips side by side, of `left` and `right` cells along their shared side.
GroundMesh strips(int left, int right, double gap)
{
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    const auto add = [&](double x, int count) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (int i = 0; i <= count; ++i)
            for (const double side : {0.0, 4.0})
                positions.emplace_back(x + side, 0.0, 10.0 * i / count);
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
            const std::uint32_t a = first + 2 * i;
            triangles.emplace_back(a, a + 2, a + 1);
            triangles.emplace_back(a + 1, a + 2, a + 3);
        }
    };
    add(-4.0 - gap, left);
    add(0.0, right);
    GroundMesh mesh = meshes::soup(positions, triangles);
    mesh.precision = 1e-3;
    return mesh;
}

TEST(Seams, WithTJunctionsAreNoBorders)
{
    for (const auto& [left, right] : {std::pair(1, 1), {1, 2}, {2, 6}, {3, 1}, {1, 7}})
        for (const double gap : {0.0, 4e-4}) {
            const Topology topology = analyse(strips(left, right, gap));
            EXPECT_EQ(topology.components, 1U);
            // The outer sides, and four ends.
            EXPECT_EQ(topology.borderEdgeCount, std::uint64_t(left + right + 4))
                << left << " " << right << " " << gap;
        }
}

TEST(Seams, WiderThanThePrecisionAreBorders)
{
    for (const double gap : {2e-3, 0.1, 3.0}) {
        const Topology topology = analyse(strips(2, 6, gap));
        EXPECT_EQ(topology.components, 2U);
        EXPECT_EQ(topology.borderEdgeCount, 20U);
        EXPECT_EQ(topology.seamVertexCount, 0U);
    }
    // Exact ground has no seams but those of equal positions.
    GroundMesh exact = strips(2, 2, 1e-4);
    exact.precision = 0.0;
    EXPECT_EQ(analyse(exact).components, 2U);
}

TEST(Seams, AreNeverWiderThanATwentiethOfTheEdges)
{
    // A precision of the size of the mesh itself merges nothing.
    for (const double precision : {0.1, 1.0, 100.0}) {
        GroundMesh mesh = meshes::grid(8, 8.0);
        mesh.precision = precision;
        const Topology topology = analyse(mesh);
        EXPECT_EQ(topology.weldedVertices, 81U);
        EXPECT_EQ(topology.borderEdgeCount, 32U);
        EXPECT_EQ(topology.seamVertexCount + topology.seamEdgeCount, 0U);
    }
}

TEST(Seams, OfTextsHaveThePrecisionOfTheirDecimals)
{
    // The same corner of two tiles, rounded to another last digit.
    const std::string obj = "v 0.000 0 0.000\nv 0.000 0 3.333\nv 3.333 0 0.000\nv 3.333 0 3.333\n"
                            "v 3.334 0 0.000\nv 3.334 0 3.333\nv 6.667 0 0.000\nv 6.667 0 3.333\n"
                            "f 1 2 4 3\nf 5 6 8 7\n";
    const Topology topology = analyse(loadContent("a.obj", obj));
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.borderEdgeCount, 6U);
    EXPECT_EQ(topology.seamVertexCount, 2U);
}

} // namespace
} // namespace sward::terrain
