#include "core/error.h"
#include "support/meshes.h"
#include "terrain/load.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ErrorKind kindOf(const std::string& input, const ImportSettings& settings = {},
                 std::string* message = nullptr)
{
    Diagnostics diagnostics;
    try {
        load(input, settings, diagnostics);
    } catch (const Error& error) {
        if (message != nullptr)
            *message = error.what();
        return error.kind();
    }
    return ErrorKind::difference;
}

TEST(GlobMatches, HasStarsAndQuestionMarks)
{
    EXPECT_TRUE(globMatches("grass", "grass"));
    EXPECT_TRUE(globMatches("gr*", "grass"));
    EXPECT_TRUE(globMatches("*ss", "grass"));
    EXPECT_TRUE(globMatches("g?a*s", "grass"));
    EXPECT_TRUE(globMatches("*a*a*", "banana"));
    EXPECT_TRUE(globMatches("*", ""));
    EXPECT_FALSE(globMatches("?", ""));
    EXPECT_FALSE(globMatches("gras", "grass"));
    EXPECT_FALSE(globMatches("Grass", "grass"));
    EXPECT_FALSE(globMatches("*x", "grass"));
    EXPECT_FALSE(globMatches(std::string(60, '*') + "x", std::string(2000, 'a')));
}

TEST(Load, PrefersAFileToABuiltInOfItsName)
{
    const ScratchFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    folder.write("sphere", "not a mesh");
    std::filesystem::current_path(folder.path(""));
    const ErrorKind kind = kindOf("sphere");
    std::filesystem::current_path(before);
    EXPECT_EQ(kind, ErrorKind::unsupported) << "a file without an extension is no mesh";
    EXPECT_EQ(kindOf("sphere"), ErrorKind::difference);
}

TEST(Load, RefusesFilesOfMoreThan4GiB)
{
    // They lie there without their bytes.
    const ScratchFolder folder;
    nlohmann::json document = nlohmann::json::parse(triangleGlb().gltf());
    document["buffers"][0] = {{"uri", "huge.bin"}, {"byteLength", (4ULL << 30) + 1}};
    folder.write("huge.bin", "");
    std::filesystem::resize_file(folder.path("huge.bin"), (4ULL << 30) + 1);
    const std::string outside = folder.write("outside.gltf", document.dump());
    for (const char* name :
         {"a.glb", "a.obj", "a.ply", "a.stl", "a.off", "a.png", "a.r16", "a.exr"}) {
        folder.write(name, "");
        std::filesystem::resize_file(folder.path(name), (4ULL << 30) + 1);
    }
    for (const char* name :
         {"outside.gltf", "a.glb", "a.obj", "a.ply", "a.stl", "a.off", "a.png", "a.r16", "a.exr"})
        try {
            Diagnostics diagnostics;
            load(folder.path(name).string(), {}, diagnostics);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::unsupported) << error.what();
            EXPECT_THAT(error.what(), testing::HasSubstr("4294967296"));
        }
}

TEST(Load, NamesWhatIsMissing)
{
    std::string message;
    EXPECT_EQ(kindOf("spher", {}, &message), ErrorKind::io);
    EXPECT_THAT(message, HasSubstr("did you mean sphere"));
    EXPECT_EQ(kindOf("/nowhere/a.glb", {}, &message), ErrorKind::io);
    EXPECT_THAT(message, HasSubstr("/nowhere/a.glb"));
    const ScratchFolder folder;
    folder.write("Ground.glb", "");
    EXPECT_EQ(kindOf(folder.path("ground.glb").string(), {}, &message), ErrorKind::io);
    EXPECT_THAT(message, HasSubstr("did you mean Ground.glb?"));
}

TEST(Load, RefusesSettingsThatMakeNoSense)
{
    EXPECT_EQ(kindOf("plane", {.upAxis = "w"}), ErrorKind::usage);
    EXPECT_EQ(kindOf("plane", {.units = "yd"}), ErrorKind::usage);
    EXPECT_EQ(kindOf("plane", {.scale = 0.0}), ErrorKind::usage);
    EXPECT_EQ(kindOf("plane", {.scale = -1.0}), ErrorKind::usage);
    EXPECT_EQ(kindOf("plane", {.scale = 2e9}), ErrorKind::usage);
}

TEST(Load, ScalesABuiltInAsAFile)
{
    Diagnostics diagnostics;
    const GroundMesh mesh = load("sphere", {.scale = 0.1}, diagnostics);
    EXPECT_NEAR(static_cast<double>(mesh.bounds().high.x), 1.0, 1e-6);
    EXPECT_EQ(mesh.triangles.size(), 16128U);
}

// Two nodes "field/lawn" and "field/rock", and one "hut", each with a triangle.
std::string threeNodes()
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["name"] = "lawn";
    builder.node({{"mesh", 0}, {"name", "rock"}});
    builder.node({{"children", {0, 1}}, {"name", "field"}});
    builder.node({{"mesh", 0}, {"name", "hut"}});
    return builder.glb();
}

TEST(Load, LetsOnlyTheNamedNodesBear)
{
    const std::string file = threeNodes();
    const auto bears = [&](const ImportSettings& settings) {
        return loadContent("a.glb", file, settings).bears;
    };
    EXPECT_THAT(bears({.bareNames = false}), ElementsAre(1, 1, 1));
    EXPECT_THAT(bears({.bearingNodes = {"lawn"}}), ElementsAre(1, 0, 0));
    EXPECT_THAT(bears({.bearingNodes = {"field"}}), ElementsAre(1, 1, 0))
        << "a group names its leaves";
    EXPECT_THAT(bears({.bearingNodes = {"field/r*"}}), ElementsAre(0, 1, 0));
    EXPECT_THAT(bears({.bearingNodes = {"lawn", "h?t"}}), ElementsAre(1, 0, 1));
    EXPECT_THAT(bears({.occluderNodes = {"rock"}}), ElementsAre(1, 0, 1));
    EXPECT_THAT(bears({.bearingNodes = {"field"}, .occluderNodes = {"rock"}}),
                ElementsAre(1, 0, 0));
}

TEST(Load, WarnsOfAGlobThatMatchesNothing)
{
    for (const ImportSettings& settings :
         {ImportSettings{.bearingNodes = {"lawm", "lawn"}},
          ImportSettings{.occluderNodes = {"lawm"}, .bareNames = false},
          ImportSettings{.bearingNodes = {"lawm"}, .mayMatchNothing = true}}) {
        Diagnostics diagnostics;
        loadContent("a.glb", threeNodes(), settings, &diagnostics);
        EXPECT_THAT(diagnostics.warnings(), ElementsAre(HasSubstr("lawm")));
    }
}

TEST(Load, RefusesNamesOfWhichNoneMatches)
{
    for (const ImportSettings& settings : {ImportSettings{.bearingNodes = {"lawm", "tree"}},
                                           ImportSettings{.bearingMaterials = {"lawm", "tree"}}}) {
        try {
            loadContent("a.glb", threeNodes(), settings);
            ADD_FAILURE() << "nothing bears grass";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("a.glb"), HasSubstr("lawm, tree"),
                                                     HasSubstr("matches none of its")));
        }
    }
}

TEST(ContentHash, TellsGroundsApart)
{
    const GroundMesh mesh = meshes::cube();
    const std::string hash = contentHash(mesh);
    EXPECT_EQ(hash.size(), 16U);
    EXPECT_EQ(hash, contentHash(meshes::cube()));

    GroundMesh other = mesh;
    other.positions[3].x += 1e-6f;
    EXPECT_NE(contentHash(other), hash);
    other = mesh;
    other.bears[5] = 0;
    EXPECT_NE(contentHash(other), hash);
    other = mesh;
    other.origin.x += 32.0;
    EXPECT_NE(contentHash(other), hash);
    other = mesh;
    other.colors[2].y = 0.5f;
    EXPECT_NE(contentHash(other), hash);
    other = mesh;
    std::swap(other.triangles[0], other.triangles[1]);
    EXPECT_NE(contentHash(other), hash);
}

} // namespace
} // namespace sward::terrain
