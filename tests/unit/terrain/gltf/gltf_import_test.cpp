#include "core/error.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A square of two triangles in the x-z plane as the corners of triangles, so that variants compare.
std::vector<glm::vec3> corners(const GroundMesh& mesh)
{
    std::vector<glm::vec3> result;
    for (const glm::uvec3& t : mesh.triangles)
        for (glm::length_t c = 0; c < 3; ++c)
            result.push_back(mesh.positions[t[c]]);
    return result;
}

// Four points of a strip that zigzags along x, facing up.
const std::vector<float> zigzag = {0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, -1};

GroundMesh loadMode(int mode, const std::vector<float>& positions,
                    const std::vector<std::uint16_t>& indices)
{
    GlbBuilder builder;
    nlohmann::json primitive = {{"mode", mode}};
    primitive["attributes"]["POSITION"] = builder.floats(positions, "VEC3");
    if (!indices.empty())
        primitive["indices"] = builder.shorts(indices, "SCALAR");
    builder.mesh(primitive);
    builder.node({{"mesh", 0}});
    return loadContent("a.glb", builder.glb());
}

void expectAllUp(const GroundMesh& mesh)
{
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        EXPECT_GT(mesh.faceNormal(i).y, 0.99) << "triangle " << i;
}

TEST(GltfImport, ReadsATriangleWithItsNormal)
{
    const GroundMesh mesh = loadContent("a.glb", triangleGlb().glb());
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, 0, -1));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
    EXPECT_TRUE(mesh.hasNormals);
    EXPECT_FALSE(mesh.hasColors);
    EXPECT_THAT(mesh.nodes, ElementsAre("patch"));
    EXPECT_DOUBLE_EQ(mesh.area(0), 0.5);
}

TEST(GltfImport, ReadsTheSameFromGltfWithADataUri)
{
    EXPECT_EQ(contentHash(loadContent("a.gltf", triangleGlb().gltf())),
              contentHash(loadContent("a.glb", triangleGlb().glb())));
}

TEST(GltfImport, ReadsBuffersBesideTheFileByPercentEncodedName)
{
    const GlbBuilder builder = triangleGlb();
    nlohmann::json document = nlohmann::json::parse(builder.gltf());
    document["buffers"][0]["uri"] = "parts/my%20ground.bin";
    const ScratchFolder folder;
    folder.write("parts/my ground.bin", builder.binary());
    const std::string path = folder.write("a.gltf", document.dump());
    Diagnostics diagnostics;
    EXPECT_EQ(load(path, {}, diagnostics).triangles.size(), 1U);
}

TEST(GltfImport, ReadsNamesInEveryWriting)
{
    const ScratchFolder folder;
    nlohmann::json document = nlohmann::json::parse(triangleGlb().gltf());
    folder.write("Täler & Höhen/50% + #1.bin", triangleGlb().binary());
    Diagnostics diagnostics;
    for (const char* uri :
         {"Täler & Höhen/50% + #1.bin", "T%C3%A4ler%20%26%20H%C3%B6hen/50%25 + %231.bin",
          "./Täler & Höhen/../Täler & Höhen/50%25 + #1.bin"}) {
        document["buffers"][0]["uri"] = uri;
        EXPECT_EQ(load(folder.write("草.gltf", document.dump()), {}, diagnostics).triangles.size(),
                  1U)
            << uri;
    }
    // An absolute name is also resolved in the file's folder.
    document["buffers"][0]["uri"] = "/Täler & Höhen/50% + #1.bin";
    EXPECT_EQ(load(folder.write("a.gltf", document.dump()), {}, diagnostics).triangles.size(), 1U);
}

TEST(GltfImport, ReadsABufferThatIsLongerThanItSays)
{
    const ScratchFolder folder;
    nlohmann::json document = nlohmann::json::parse(triangleGlb().gltf());
    folder.write("long.bin", triangleGlb().binary() + "and more");
    document["buffers"][0]["uri"] = "long.bin";
    Diagnostics diagnostics;
    EXPECT_EQ(load(folder.write("a.gltf", document.dump()), {}, diagnostics).triangles.size(), 1U);
}

TEST(GltfImport, NamesAMissingBuffer)
{
    nlohmann::json document = nlohmann::json::parse(triangleGlb().gltf());
    document["buffers"][0]["uri"] = "gone.bin";
    try {
        loadContent("a.gltf", document.dump());
        FAIL() << "a missing buffer was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_THAT(error.what(), HasSubstr("gone.bin"));
    }
}

TEST(GltfImport, GivesEveryIndexTypeTheSameTriangles)
{
    std::vector<std::string> hashes;
    for (const int kind : {0, 1, 2}) {
        GlbBuilder builder;
        nlohmann::json primitive;
        primitive["attributes"]["POSITION"] = builder.floats(zigzag, "VEC3");
        primitive["indices"] = kind == 0   ? builder.bytes({0, 1, 2, 2, 1, 3}, "SCALAR")
                               : kind == 1 ? builder.shorts({0, 1, 2, 2, 1, 3}, "SCALAR")
                                           : builder.words({0, 1, 2, 2, 1, 3}, "SCALAR");
        builder.mesh(primitive);
        builder.node({{"mesh", 0}});
        hashes.push_back(contentHash(loadContent("a.glb", builder.glb())));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(GltfImport, ReadsTrianglesWithoutIndices)
{
    const GroundMesh mesh =
        loadMode(4, {0, 0, 0, 1, 0, 0, 0, 0, -1, 1, 0, 0, 1, 0, -1, 0, 0, -1}, {});
    EXPECT_EQ(mesh.triangles.size(), 2U);
    expectAllUp(mesh);
}

TEST(GltfImport, TurnsEveryOtherTriangleOfAStrip)
{
    const GroundMesh mesh = loadMode(5, zigzag, {});
    EXPECT_THAT(corners(mesh),
                ElementsAre(glm::vec3(0, 0, 1), glm::vec3(1, 0, 1), glm::vec3(0, 0, 0),
                            glm::vec3(1, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 0, 0),
                            glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1)));
    expectAllUp(mesh);
    expectAllUp(loadMode(5, zigzag, {0, 1, 2, 3, 4}));
}

TEST(GltfImport, TurnsAFanAroundItsFirstVertex)
{
    // A ring around the origin, anti-clockwise seen from above.
    const std::vector<float> ring = {0, 0, 0, 1, 0, 0, 1, 0, -1, 0, 0, -1, -1, 0, -1};
    const GroundMesh mesh = loadMode(6, ring, {});
    EXPECT_EQ(mesh.triangles.size(), 3U);
    expectAllUp(mesh);
    double area = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        area += mesh.area(i);
    EXPECT_DOUBLE_EQ(area, 1.5);
}

TEST(GltfImport, PassesOverPointsAndLinesWithAWarning)
{
    GlbBuilder builder = triangleGlb();
    builder.primitive({{"mode", 1}, {"attributes", {{"POSITION", 0}}}});
    Diagnostics diagnostics;
    EXPECT_EQ(loadContent("a.glb", builder.glb(), {}, &diagnostics).triangles.size(), 1U);
    EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("points and lines")));
}

TEST(GltfImport, ShowsAMeshAsOftenAsNodesNameIt)
{
    GlbBuilder builder = triangleGlb();
    builder.node({{"mesh", 0}, {"name", "again"}, {"translation", {5, 0, 0}}});
    const GroundMesh mesh = loadContent("a.glb", builder.glb());
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_THAT(mesh.nodes, ElementsAre("patch", "again"));
    EXPECT_THAT(mesh.nodeOf, ElementsAre(0U, 1U));
    EXPECT_EQ(worldPosition(mesh, mesh.triangles[1].y), glm::dvec3(6, 0, 0));
}

TEST(GltfImport, TakesTheSceneThatIsAskedFor)
{
    GlbBuilder builder = triangleGlb();
    builder.node({{"mesh", 0}, {"name", "other"}});
    builder.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    builder.document["scene"] = 1;
    const std::string file = builder.glb();
    EXPECT_THAT(loadContent("a.glb", file).nodes, ElementsAre("other"));
    EXPECT_THAT(loadContent("a.glb", file, {.scene = 0}).nodes, ElementsAre("patch"));
    try {
        loadContent("a.glb", file, {.scene = 2});
        FAIL() << "scene 2 of 2 was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
    }
}

TEST(GltfImport, TakesAllRootNodesOfAFileWithoutScenes)
{
    GlbBuilder builder = triangleGlb();
    builder.node({{"children", {0}}, {"name", "root"}});
    builder.node({{"mesh", 0}, {"name", "loose"}});
    builder.document["scenes"] = nlohmann::json::array();
    EXPECT_THAT(loadContent("a.glb", builder.glb()).nodes, ElementsAre("root/patch", "loose"));
}

TEST(GltfImport, KeepsTheCopyright)
{
    GlbBuilder builder = triangleGlb();
    builder.document["asset"]["copyright"] = "CC0 A. Author";
    EXPECT_EQ(loadContent("a.glb", builder.glb()).copyright, "CC0 A. Author");
}

} // namespace
} // namespace sward::terrain
