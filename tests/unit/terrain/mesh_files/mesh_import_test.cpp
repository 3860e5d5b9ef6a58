#include "core/error.h"
#include "support/meshes.h"
#include "unit/terrain/gltf/glb_builder.h"
#include "unit/terrain/image_files.h"
#include "unit/terrain/mesh_files/mesh_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(MeshImport, ReadsTheSameCubeFromEveryFormat)
{
    const GroundMesh cube = meshes::cube();
    for (const CubeFile& file : cubeFiles()) {
        const GroundMesh mesh = loadContent(file.name, file.content);
        EXPECT_EQ(mesh.triangles.size(), 12U) << file.name;
        EXPECT_NEAR(meshes::signedVolume(mesh), 8.0, 1e-6) << file.name;
        EXPECT_NEAR(meshes::totalArea(mesh), 24.0, 1e-6) << file.name;
        ASSERT_EQ(mesh.positions.size(), cube.positions.size()) << file.name;
        // Its edges are sharp: each corner has the normals of its three sides.
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (glm::length_t c = 0; c < 3; ++c)
                EXPECT_EQ(mesh.normals[mesh.triangles[i][c]], glm::vec3(mesh.faceNormal(i)))
                    << file.name;
    }
}

TEST(MeshImport, CutsPolygonsIntoFans)
{
    const GroundMesh mesh =
        loadContent("a.obj", "v 0 0 0\nv 0 0 2\nv 2 0 2\nv 2 0 0\nv 1 0 -1\nf 1 2 3 4 5\n");
    EXPECT_EQ(mesh.triangles.size(), 3U);
    EXPECT_DOUBLE_EQ(meshes::totalArea(mesh), 5.0);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 1, 0));
}

TEST(MeshImport, KeepsFacesThatAreNotManifold)
{
    const GroundMesh mesh = loadContent(
        "a.off", "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n");
    EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST(MeshImport, TakesNothingBehindTheCornersOfAnOffFaceForAnotherFace)
{
    // Colours in all forms, and text that a reader parsed as a face of −1 corners.
    for (const char* const rest : {"", " 255 0 0", " 0.1 0.2 0.3 1.0", " 7", " -1", " 3 0 1 2"}) {
        const GroundMesh mesh = loadContent(
            "a.off",
            fmt::format("OFF\n4 2 0\n0 0 0\n0 0 1\n1 0 0\n1 0 1\n3 0 1 2{}\n3 2 1 3\n", rest));
        EXPECT_EQ(mesh.triangles.size(), 2U) << rest;
        EXPECT_DOUBLE_EQ(meshes::totalArea(mesh), 1.0) << rest;
    }
}

TEST(MeshImport, KeepsATenthOfAMillimetreAMillionMetresAway)
{
    const char* const vertices[] = {"1000000.0001 2 -3000000", "1000000.0001 2 -2999999.9998",
                                    "1000000.0004 2 -3000000"};
    const std::string lines = fmt::format("{}\n{}\n{}\n", vertices[0], vertices[1], vertices[2]);
    const std::string ascii =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty "
        "double "
        "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        lines + "3 0 1 2\n";
    const std::vector<std::pair<std::string, std::string>> files = {
        {"a.obj",
         fmt::format("v {}\nv {}\nv {}\nf 1 2 3\n", vertices[0], vertices[1], vertices[2])},
        {"a.off", "OFF\n3 1 0\n" + lines + "3 0 1 2\n"},
        {"a.ply", ascii},
        {"a.stl", fmt::format("solid a\nfacet normal 0 1 0\nouter loop\nvertex {}\nvertex {}\n"
                              "vertex {}\nendloop\nendfacet\nendsolid a\n",
                              vertices[0], vertices[1], vertices[2])},
        {"b.ply", binaryPly({1000000.0001, 2, -3000000, 1000000.0001, 2, -2999999.9998,
                             1000000.0004, 2, -3000000})},
    };
    for (const auto& [name, content] : files) {
        Diagnostics diagnostics;
        const GroundMesh mesh = loadContent(name, content, {}, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty()) << name;
        EXPECT_NEAR(worldPosition(mesh, 0).x, 1000000.0001, 2e-6) << name;
        EXPECT_NEAR(worldPosition(mesh, 1).z, -2999999.9998, 2e-6) << name;
        EXPECT_NEAR(mesh.area(0), 0.5 * 0.0002 * 0.0003, 2e-10) << name;
    }
}

TEST(MeshImport, WarnsWhereAFormatIsTooCoarse)
{
    const float numbers[12] = {0, 1, 0, 100000, 0, 0, 100000, 0, 1, 100001, 0, 0};
    std::string far(84, '\0');
    far[80] = 1;
    far.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
    Diagnostics diagnostics;
    loadContent("a.stl", far, {}, &diagnostics);
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("single precision")));

    // In millimetres the same numbers lie within 100 m.
    Diagnostics near;
    loadContent("a.stl", far, {.units = "mm"}, &near);
    EXPECT_THAT(near.warnings(), testing::IsEmpty());
}

TEST(MeshImport, NamesPartsOfAnObjByObjectAndMaterial)
{
    const GroundMesh mesh = loadContent(
        "a.obj",
        "mtllib none.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\no lawn\nusemtl tall grass\nf 1 2 "
        "3\no path\nusemtl gravel\nf 3 2 4\n");
    EXPECT_THAT(mesh.nodes, ElementsAre("lawn", "path"));
    EXPECT_THAT(mesh.nodeOf, ElementsAre(0U, 1U));
    EXPECT_EQ(mesh.materials[0].name, "tall grass");
    EXPECT_THAT(mesh.materialOf, ElementsAre(0U, 1U));
}

// A triangle in each of two materials, and one in neither.
const char* const objOfTwoMaterials = "mtllib my meadow.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 0\n"
                                      "f 1 2 3\nusemtl grass\nf 1 2 3\nusemtl bare rock\n"
                                      "f 1 2 3\n";

TEST(MeshImport, ReadsColorsAndImagesOfMaterialLibraries)
{
    const ScratchFolder folder;
    const std::string obj = folder.write("a.obj", objOfTwoMaterials);
    folder.write("my meadow.mtl", "# two of them\nnewmtl grass\nNs 10\nKd 0.25 0.5 0.125\n"
                                  "map_Kd -s 1 1 1 -clamp on maps\\green blades.png\n"
                                  "newmtl unused\nKd 1 0 0\nnewmtl bare rock\nKd 0.5 0.5 0.5\n");
    folder.write("maps/green blades.png", greyPng({2, 1}, {0, 255}, 8));
    Diagnostics diagnostics;
    const GroundMesh mesh = load(obj, {.bareNames = false}, diagnostics);
    ASSERT_EQ(mesh.materials.size(), 3U);
    EXPECT_THAT(mesh.materialOf, ElementsAre(0U, 1U, 2U));
    EXPECT_EQ(mesh.materials[0].name, "ground");
    EXPECT_EQ(mesh.materials[1].baseColor, glm::vec4(0.25f, 0.5f, 0.125f, 1.0f));
    EXPECT_EQ(mesh.materials[2].baseColor, glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    EXPECT_EQ(mesh.materials[2].image, GroundMaterial::noImage);
    ASSERT_EQ(mesh.materials[1].image, 0U);
    EXPECT_EQ(mesh.materials[1].wrapU, ImageWrap::clamp);
    EXPECT_EQ(mesh.images[0].name, "green blades.png");
    EXPECT_THAT(mesh.images[0].rgba, ElementsAre(0, 0, 0, 255, 255, 255, 255, 255));
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("-s of its image")));
}

TEST(MeshImport, WarnsOfWhatALibraryDoesNotHave)
{
    const ScratchFolder folder;
    const std::string obj = folder.write("a.obj", objOfTwoMaterials);
    Diagnostics missing;
    EXPECT_EQ(load(obj, {.bareNames = false}, missing).triangles.size(), 3U);
    EXPECT_THAT(missing.warnings(), ElementsAre(HasSubstr("library my"), HasSubstr("meadow.mtl")));

    folder.write("my meadow.mtl", "Kd 1 1 1\nnewmtl grass\nKd green\nmap_Kd gone.png\n");
    Diagnostics poor;
    const GroundMesh mesh = load(obj, {.bareNames = false}, poor);
    EXPECT_EQ(mesh.materials[1].image, GroundMaterial::noImage);
    EXPECT_THAT(poor.warnings(), ElementsAre(HasSubstr("line 3: Kd"), HasSubstr("gone.png"),
                                             HasSubstr("bare rock")));
}

TEST(MeshImport, FindsALibraryOfAnotherMachineByItsName)
{
    const ScratchFolder folder;
    const std::string obj = folder.write(
        "a.obj", "mtllib C:\\work\\a.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 0\nusemtl m\nf 1 2 3\n");
    folder.write("a.mtl", "newmtl m\nKd 0 1 0\n");
    Diagnostics diagnostics;
    EXPECT_EQ(load(obj, {}, diagnostics).materials[0].baseColor, glm::vec4(0, 1, 0, 1));
    EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(MeshImport, KeepsColorsNormalsAndTextureCoordinates)
{
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                            "float y\nproperty float z\n"
                            "property float nx\nproperty float ny\nproperty float nz\nproperty "
                            "uchar red\nproperty uchar "
                            "green\nproperty uchar blue\nproperty float s\nproperty float "
                            "t\nelement face 1\nproperty list "
                            "uchar int vertex_indices\nend_header\n0 0 0 0.6 0.8 0 51 102 255 0.25 "
                            "0.75\n0 0 1 0 1 0 0 0 0 0 0\n1 "
                            "0 0 0 1 0 0 0 0 1 1\n3 0 1 2\n";
    const GroundMesh mesh = loadContent("a.ply", ply);
    EXPECT_TRUE(mesh.hasColors);
    EXPECT_TRUE(mesh.hasNormals);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0.6f, 0.8f, 0.0f));
    EXPECT_EQ(mesh.colors[0], glm::vec4(0.2f, 0.4f, 1.0f, 1.0f));
    // Images begin at the top, PLY at the bottom.
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.25f, 0.25f));
}

TEST(MeshImport, PassesOverWhatGroundDoesNotNeedOfAPly)
{
    const std::string ply =
        "ply\r\nformat ascii 1.0\r\ncomment as other programs write it\r\nobj_info one\r\n"
        "element camera 1\r\nproperty float fov\r\nelement vertex 3\r\nproperty float x\r\n"
        "property float quality\r\nproperty float y\r\nproperty float z\r\nelement face 1\r\n"
        "property uchar flags\r\nproperty list uchar int vertex_index\r\nproperty list uchar float "
        "texcoord\r\nelement edge 1\r\nproperty int vertex1\r\nend_header\r\n0.9\r\n0 7 0 0\r\n"
        "0 7 0 1\r\n1 7 0 0\r\n7 3 0 1 2 6 0 0 0 1 1 0\r\n5\r\n";
    const GroundMesh mesh = loadContent("a.ply", ply);
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_DOUBLE_EQ(mesh.area(0), 0.5);
}

TEST(MeshImport, LeavesOutFacesOfTwoCorners)
{
    EXPECT_EQ(
        loadContent("a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nl 1 2\nf 1 2\nf 1 2 3\n").triangles.size(),
        1U);
}

TEST(MeshImport, SplitsAVertexWhoseCornersHaveOtherTextureCoordinates)
{
    const GroundMesh mesh = loadContent(
        "a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\nvt 0 0\nvt 0 1\nvt 1 0\nvt 0.5 0.5\n"
                 "f 1/1 2/2 3/3\nf 3/4 2/2 4/1\n");
    EXPECT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.uvs[mesh.triangles[0].z], glm::vec2(1.0f, 1.0f));
    EXPECT_EQ(mesh.uvs[mesh.triangles[1].x], glm::vec2(0.5f, 0.5f));
    EXPECT_EQ(mesh.positions[mesh.triangles[0].z], mesh.positions[mesh.triangles[1].x]);
}

TEST(MeshImport, TurnsZUpCentimetresIntoYUpMetres)
{
    const GroundMesh metres = loadContent("a.obj", "v 0 0 0\nv 2 0 0\nv 0 1 -3\nf 1 2 3\n");
    const GroundMesh centimetres = loadContent(
        "a.obj", "v 0 0 0\nv 200 0 0\nv 0 300 100\nf 1 2 3\n", {.upAxis = "z", .units = "cm"});
    for (std::size_t i = 0; i < 3; ++i)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(metres.positions[i][axis], centimetres.positions[i][axis], 1e-6);
    EXPECT_EQ(metres.triangles, centimetres.triangles);
}

TEST(MeshImport, TurnsEveryAxisUpWithoutAMirror)
{
    for (const char* axis : {"x", "y", "z", "-x", "-y", "-z"}) {
        // A tetrahedron with a longest edge along the axis.
        glm::dvec3 up(0.0);
        up[static_cast<std::size_t>(std::string(axis).back() - 'x')] = axis[0] == '-' ? -9.0 : 9.0;
        const std::string obj =
            fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv {} {} {}\n", up.x, up.y, up.z) +
            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 5\n";
        const GroundMesh mesh = loadContent("a.obj", obj, {.upAxis = axis});
        EXPECT_EQ(worldPosition(mesh, mesh.triangles[4].z), glm::dvec3(0, 9, 0)) << axis;
        double volume = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            volume += glm::dot(
                glm::dvec3(mesh.positions[t.x]),
                glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
        }
        EXPECT_NEAR(volume, 1.0, 1e-6) << axis;
    }
}

} // namespace
} // namespace sward::terrain
