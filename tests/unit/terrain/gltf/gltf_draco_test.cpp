#include "core/error.h"
#include "unit/terrain/gltf/compressed_glb.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::terrain {
namespace {

using testing::HasSubstr;

constexpr const char* name = "KHR_draco_mesh_compression";

ErrorKind kindOfDraco(const GlbBuilder& builder, std::string* message = nullptr)
{
    try {
        loadContent("a.glb", builder.glb());
    } catch (const Error& error) {
        if (message != nullptr)
            *message = error.what();
        return error.kind();
    }
    return ErrorKind::difference;
}

// Order-independent triangle: its corner positions, smallest first, rounded to `grain` [m].
using Corners = std::array<std::array<long, 3>, 3>;

std::vector<Corners> trianglesOf(const GroundMesh& mesh, double grain)
{
    std::vector<Corners> triangles;
    for (const glm::uvec3& triangle : mesh.triangles) {
        Corners corners;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corners[c][axis] =
                    std::lround(worldPosition(mesh, triangle[int(c)])[int(axis)] / grain);
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
        triangles.push_back(corners);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

TEST(GltfDraco, DecodesSequentialMeshesToTheVeryBytes)
{
    EXPECT_EQ(contentHash(loadContent("a.glb", dracoGrid(20, {.edgebreaker = false}).glb())),
              contentHash(loadContent("a.glb", plainGrid(20).glb())));
}

TEST(GltfDraco, KeepsEveryTriangleOfAnEdgebreakerMesh)
{
    const GroundMesh plain = loadContent("a.glb", plainGrid(20).glb());
    const GroundMesh mesh = loadContent("a.glb", dracoGrid(20).glb());
    EXPECT_EQ(mesh.positions.size(), plain.positions.size());
    EXPECT_TRUE(mesh.hasNormals);
    EXPECT_EQ(trianglesOf(mesh, 1e-6), trianglesOf(plain, 1e-6));
}

TEST(GltfDraco, DecodesQuantisedAttributes)
{
    const GroundMesh plain = loadContent("a.glb", plainGrid(20).glb());
    for (const bool edgebreaker : {false, true}) {
        const GroundMesh mesh =
            loadContent("a.glb", dracoGrid(20, {.edgebreaker = edgebreaker, .bits = 14}).glb());
        ASSERT_EQ(mesh.positions.size(), plain.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            std::size_t nearest = 0;
            for (std::size_t j = 1; j < plain.positions.size(); ++j)
                if (glm::distance(plain.positions[j], mesh.positions[i]) <
                    glm::distance(plain.positions[nearest], mesh.positions[i]))
                    nearest = j;
            // Ten metres in 2¹⁴ steps.
            EXPECT_LT(glm::distance(plain.positions[nearest], mesh.positions[i]), 1e-3f);
            EXPECT_LT(glm::distance(plain.normals[nearest], mesh.normals[i]), 1e-3f);
            EXPECT_LT(glm::distance(plain.uvs[nearest], mesh.uvs[i]), 1e-3f);
        }
    }
}

TEST(GltfDraco, LetsPrimitivesShareAMesh)
{
    GlbBuilder builder = dracoGrid(6);
    builder.primitive(builder.document["meshes"][0]["primitives"][0]);
    EXPECT_EQ(loadContent("a.glb", builder.glb()).triangles.size(), 2U * 72U);
}

TEST(GltfDraco, TakesThePlainCopyWhereTheExtensionIsNotRequired)
{
    GlbBuilder builder = plainGrid(6);
    builder.document["extensionsUsed"] = {name};
    builder.document["meshes"][0]["primitives"][0]["extensions"][name] = {
        {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    EXPECT_EQ(contentHash(loadContent("a.glb", builder.glb())),
              contentHash(loadContent("a.glb", plainGrid(6).glb())));
    builder.document["extensionsRequired"] = {name};
    EXPECT_EQ(kindOfDraco(builder), ErrorKind::input) << "positions are no Draco mesh";
}

TEST(GltfDraco, RefusesCountsThatTheMeshDoesNotHave)
{
    std::string message;
    for (const std::size_t accessor : {0U, 1U, 2U, 3U})
        for (const std::uint64_t count : {0ULL, 3ULL, 215ULL, 219ULL, 75'000'000ULL, 1ULL << 31}) {
            GlbBuilder builder = dracoGrid(6);
            builder.document["accessors"][accessor]["count"] = count;
            EXPECT_EQ(kindOfDraco(builder, &message), ErrorKind::input)
                << accessor << ": " << count;
            EXPECT_THAT(message, HasSubstr("mesh 0"));
        }
}

TEST(GltfDraco, RefusesWhatDoesNotFit)
{
    const std::vector<std::pair<const char*, nlohmann::json>> wrong = {
        {"bufferView", 7},
        {"bufferView", -1},
        {"attributes", nlohmann::json::object()},
        {"attributes", {{"POSITION", 77}}},
        {"attributes", {{"POSITION", "zero"}}},
        {"attributes", {{"SOMETHING", 0}}}};
    for (const auto& [key, value] : wrong) {
        GlbBuilder builder = dracoGrid(6);
        builder.document["meshes"][0]["primitives"][0]["extensions"][name][key] = value;
        std::string message;
        EXPECT_EQ(kindOfDraco(builder, &message), ErrorKind::input) << key << " = " << value;
        EXPECT_THAT(message, HasSubstr("mesh 0")) << key << " = " << value;
    }
    GlbBuilder noIndices = dracoGrid(6);
    noIndices.document["meshes"][0]["primitives"][0].erase("indices");
    EXPECT_EQ(kindOfDraco(noIndices), ErrorKind::input);
    GlbBuilder lines = dracoGrid(6);
    lines.document["meshes"][0]["primitives"][0]["mode"] = 1;
    EXPECT_EQ(kindOfDraco(lines), ErrorKind::input);
}

TEST(GltfDraco, RefusesOtherBitStreams)
{
    std::string file = dracoGrid(6).glb();
    file[file.find("DRACO") + 6] = 1;
    try {
        loadContent("a.glb", file);
        ADD_FAILURE() << "bit stream 2.1 was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_THAT(error.what(), HasSubstr("2.1"));
    }
}

TEST(GltfDraco, SurvivesEveryFlippedByteAndEveryTruncation)
{
    for (const bool edgebreaker : {false, true}) {
        const GlbBuilder builder = dracoGrid(5, {.edgebreaker = edgebreaker, .bits = 10});
        const std::string file = builder.glb();
        for (std::size_t at = file.find("DRACO"); at < file.size(); ++at)
            for (const unsigned mask : {0x01U, 0x10U, 0x80U, 0xffU}) {
                std::string damaged = file;
                damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ mask);
                try {
                    loadContent("a.glb", damaged);
                } catch (const Error& error) {
                    EXPECT_THAT(error.what(), HasSubstr("a.glb"));
                }
            }
        GlbBuilder cut = builder;
        const auto whole = cut.document["bufferViews"][0]["byteLength"].get<std::size_t>();
        for (std::size_t length = 1; length < whole; ++length) {
            cut.document["bufferViews"][0]["byteLength"] = length;
            try {
                loadContent("a.glb", cut.glb());
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
            }
        }
    }
}

} // namespace
} // namespace sward::terrain
