#include "core/error.h"
#include "core/files/mapped_file.h"
#include "support/meshes.h"
#include "terrain/gltf/export.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace sward::terrain {
namespace {

GroundMesh roundTrip(const GroundMesh& mesh)
{
    const ScratchFolder folder;
    const std::filesystem::path path = folder.path("a.glb");
    exportGltf(mesh, path, false);
    Diagnostics diagnostics;
    GroundMesh back = load(path.string(), {.bareNames = false}, diagnostics);
    EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty());
    return back;
}

// Ground with everything that a GroundMesh can hold.
GroundMesh fullMesh()
{
    GroundMesh mesh = meshes::moved(meshes::boxAbovePlane(), {1e6 + 1.0 / 3.0, -2e5, 3e6});
    mesh.nodes = {"garden/lawn", "garden/box"};
    mesh.materials = {{.name = "grass",
                       .baseColor = {0.1f, 0.7f, 0.2f, 1.0f},
                       .roughness = 0.3f,
                       .image = 0,
                       .wrapV = ImageWrap::mirror},
                      {.name = "stone", .metallic = 0.25f, .doubleSided = true}};
    mesh.images = {
        {.name = "blades", .width = 2, .height = 1, .rgba = {1, 2, 3, 255, 40, 50, 60, 128}}};
    mesh.copyright = "CC0 A. Author";
    mesh.hasColors = true;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        mesh.nodeOf[i] = i < 2 ? 0 : 1;
        mesh.materialOf[i] = i < 2 ? 0 : 1;
    }
    for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
        mesh.colors[i] = glm::vec4(static_cast<float>(i) / 64.0f, 0.5f, 0.3f, 1.0f);
        mesh.uvs[i] = glm::vec2(static_cast<float>(i), 0.125f);
    }
    return mesh;
}

TEST(GltfExport, ComesBackAsItWas)
{
    const GroundMesh mesh = fullMesh();
    const GroundMesh back = roundTrip(mesh);
    EXPECT_EQ(back.origin, mesh.origin);
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.normals, mesh.normals);
    EXPECT_EQ(back.uvs, mesh.uvs);
    EXPECT_EQ(back.colors, mesh.colors);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.nodes, mesh.nodes);
    EXPECT_EQ(back.nodeOf, mesh.nodeOf);
    EXPECT_EQ(back.materialOf, mesh.materialOf);
    EXPECT_EQ(back.copyright, mesh.copyright);
    EXPECT_EQ(back.materials[0].baseColor, mesh.materials[0].baseColor);
    EXPECT_EQ(back.materials[0].roughness, mesh.materials[0].roughness);
    EXPECT_EQ(back.materials[1].metallic, mesh.materials[1].metallic);
    EXPECT_EQ(back.materials[1].name, "stone");
    EXPECT_TRUE(back.materials[1].doubleSided);
    ASSERT_EQ(back.images.size(), 1U);
    EXPECT_EQ(back.images[0].rgba, mesh.images[0].rgba);
    EXPECT_EQ(contentHash(back), contentHash(mesh));
}

TEST(GltfExport, WritesTheSameBytesTwice)
{
    const ScratchFolder folder;
    exportGltf(fullMesh(), folder.path("a.glb"), false);
    exportGltf(fullMesh(), folder.path("b.glb"), false);
    EXPECT_EQ(readFile(folder.path("a.glb")), readFile(folder.path("b.glb")));
}

TEST(GltfExport, WritesAContainerWhoseLengthsAreTrue)
{
    const ScratchFolder folder;
    exportGltf(meshes::cube(), folder.path("a.glb"), false);
    const std::vector<std::byte> file = readFile(folder.path("a.glb"));
    std::uint32_t header[5];
    std::memcpy(header, file.data(), sizeof header);
    EXPECT_EQ(header[0], 0x46546c67U);
    EXPECT_EQ(header[2], file.size());
    EXPECT_EQ(header[3] % 4, 0U);
    const std::string text(reinterpret_cast<const char*>(file.data()) + 20, header[3]);
    const nlohmann::json document = nlohmann::json::parse(text);
    const auto& position =
        document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
                                  .get<std::size_t>()];
    EXPECT_EQ(position["min"], nlohmann::json({-1.0, -1.0, -1.0}));
    EXPECT_EQ(position["max"], nlohmann::json({1.0, 1.0, 1.0}));
}

TEST(GltfExport, LeavesAnExistingFileWhole)
{
    const ScratchFolder folder;
    folder.write("a.glb", "precious");
    EXPECT_THROW(exportGltf(meshes::cube(), folder.path("a.glb"), false), Error);
    EXPECT_EQ(readFile(folder.path("a.glb")).size(), 8U);
    exportGltf(meshes::cube(), folder.path("a.glb"), true);
    EXPECT_GT(readFile(folder.path("a.glb")).size(), 100U);
}

} // namespace
} // namespace sward::terrain
