// Tests which parts of the ground are drawn, and that culling does not change the picture.

#include "core/random.h"
#include "picture.h"
#include "render/preview/ground_clusters.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sward::render {
namespace {

/// Makes hills of `cells` × `cells` squares, 40 m wide, steep enough to hide one another.
void putHills(field::Field& field, int cells)
{
    field::DisplayGround& ground = field.ground;
    ground.vertices.clear();
    ground.indices.clear();
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const float x = 40.0f * static_cast<float>(column) / static_cast<float>(cells) - 20.0f;
            const float z = 40.0f * static_cast<float>(row) / static_cast<float>(cells) - 20.0f;
            shared::GroundVertex corner = {};
            corner.position = {x, 3.0f * std::sin(0.7f * x) * std::cos(0.5f * z), z};
            corner.color = 0xffffffffu;
            ground.vertices.push_back(corner);
        }
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const auto a = static_cast<std::uint32_t>(row * (cells + 1) + column);
            const auto b = a + static_cast<std::uint32_t>(cells) + 1;
            for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1})
                ground.indices.push_back(i);
        }
    ground.ranges = {{.level = 0,
                      .material = 0,
                      .firstIndex = 0,
                      .indexCount = static_cast<std::uint32_t>(ground.indices.size())}};
}

TEST(GroundClustersTest, HoldEachTriangleOnceAndAllOfIt)
{
    field::Field field = test::makeField({.blades = 16});
    putHills(field, 61);
    const auto& corners = field.ground.vertices;
    std::vector<std::uint32_t> sorted = field.ground.indices;
    sortTriangles(corners, sorted);
    const auto clusters = clustersOf(corners, sorted, 7);

    const auto triangles = [](const std::vector<std::uint32_t>& indices) {
        std::vector<std::array<std::uint32_t, 3>> list;
        for (std::size_t i = 0; i < indices.size(); i += 3)
            list.push_back({indices[i], indices[i + 1], indices[i + 2]});
        std::ranges::sort(list);
        return list;
    };
    EXPECT_EQ(triangles(sorted), triangles(field.ground.indices));
    std::uint32_t next = 0;
    double area = 0.0;
    for (const shared::GroundCluster& cluster : clusters) {
        EXPECT_EQ(cluster.material, 7u);
        EXPECT_TRUE(cluster.indexCount == 3 * shared::clusterTriangles ||
                    &cluster == &clusters.back());
        const std::uint32_t first = next;
        next += cluster.indexCount;
        for (std::uint32_t i = first; i < next; ++i) {
            const glm::vec3 place = corners[sorted[i]].position;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(cluster.low, place)) &&
                        glm::all(glm::lessThanEqual(place, cluster.high)));
        }
        area += double(cluster.high.x - cluster.low.x) * double(cluster.high.z - cluster.low.z);
    }
    EXPECT_EQ(next, sorted.size());
    // Neighbours are stored together; in row order each box would be 40 m wide, with about 30 times
    // the area.
    EXPECT_LT(area, 4.0 * 40.0 * 40.0);
}

/// In a grid the corners of a triangle are those of its neighbours, too; here each stands alone.
TEST(GroundClustersTest, HoldEachCornerOfTrianglesThatShareNone)
{
    std::vector<shared::GroundVertex> corners;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 3 * (2 * shared::clusterTriangles + 5); ++i) {
        shared::GroundVertex corner = {};
        for (glm::length_t axis = 0; axis < 3; ++axis)
            corner.position[axis] =
                static_cast<float>(uniform(3, i, static_cast<std::uint32_t>(axis)));
        indices.push_back(i);
        corners.push_back(corner);
    }
    // The first and the last corner of a cluster are the farthest in it.
    const std::uint32_t length = 3 * shared::clusterTriangles;
    for (std::uint32_t i = 0; i < indices.size(); i += length) {
        corners[i].position = glm::vec3(-1.0f);
        corners[std::min<std::size_t>(i + length, indices.size()) - 1].position = glm::vec3(2.0f);
    }
    for (const shared::GroundCluster& cluster : clustersOf(corners, indices, 0)) {
        EXPECT_EQ(cluster.low, glm::vec3(-1.0f));
        EXPECT_EQ(cluster.high, glm::vec3(2.0f));
    }
}

using GroundTest = test::GpuTest;

TEST_F(GroundTest, ClustersThatNobodySeesChangeNoByteOfAnyPicture)
{
    field::Field field = test::makeField({.blades = 64, .extent = 2.0f});
    putHills(field, 90);
    const field::FieldView view = field::viewOf(field);
    gpu::DeviceContext plain = context();
    plain.features.drawIndirectCount = false;
    for (const Geometry geometry : {Geometry::raster, Geometry::tessellation}) {
        const FieldRenderer::Settings wanted{.samples = 1, .geometry = geometry};
        FieldRenderer clustered(context(), view, wanted);
        FieldRenderer whole(plain, view, wanted);
        const FrameSettings settings = FrameSettings::of(view);
        test::Picture some(context(), {131, 77});
        test::Picture all(context(), {131, 77});
        for (int i = 0; i < 16; ++i) {
            Camera camera;
            const double turn = 2.0 * std::numbers::pi * i / 16.0;
            camera.eye = {15.0 * std::cos(turn), -2.0 + 0.6 * i, 15.0 * std::sin(3.0 * turn)};
            camera.target =
                camera.eye + glm::dvec3(std::sin(5.0 * turn), -0.2, std::cos(2.0 * turn));
            some.draw(clustered, camera, settings, 1.0);
            all.draw(whole, camera, settings, 1.0);
            ASSERT_EQ(test::differingPixels(some.pixels(), all.pixels()), 0u) << "camera " << i;
        }
    }
}

} // namespace
} // namespace sward::render
