#include "terrain/loading/bare_names.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReadName, FindsWholeWordsHoweverTheyAreJoined)
{
    for (const char* name :
         {"rock", "Rock_01", "bigRock", "ROCKS", "rock2", "02rock", "cliff-face", "my.water.003",
          "HouseWall", "houses", "XMLRoof", "stone path", "SM_River/Bed", "Beaches_sands"})
        EXPECT_EQ(readName(name), NameSays::bare) << name;
    for (const char* name : {"", "rocket", "brocken", "seaside", "iceland", "shrock", "wallpaper",
                             "Material.001", "hill", "terrain", "roadster", "_", "123"})
        EXPECT_EQ(readName(name), NameSays::nothing) << name;
}

TEST(ReadName, BelievesAWordForGrassFirst)
{
    for (const char* name : {"grass", "GrassyLawn", "rock_moss", "road-meadows", "wall.turf"})
        EXPECT_EQ(readName(name), NameSays::grass) << name;
}

// Nodes "field/lawn", "field/rocks/Object_3" and "hut", each with a triangle, in one group.
std::string namedNodes(const char* group)
{
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["name"] = "lawn";
    builder.node({{"mesh", 0}, {"name", "Object_3"}});
    builder.node({{"children", {1}}, {"name", "rocks"}});
    builder.node({{"mesh", 0}, {"name", "hut"}});
    builder.node({{"children", {0, 2, 3}}, {"name", group}});
    return builder.glb();
}

TEST(BareNames, LeaveTheirNodesBareAndSaySo)
{
    Diagnostics diagnostics;
    const GroundMesh mesh = loadContent("a.glb", namedNodes("scene"), {}, &diagnostics);
    EXPECT_THAT(mesh.bears, ElementsAre(1, 0, 1));
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("33.3 %"));
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("\"rocks\""));
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("--bare-names none"));
}

TEST(BareNames, OfTheWholeMeshTellNothingApart)
{
    EXPECT_THAT(loadContent("a.glb", namedNodes("lake house")).bears, ElementsAre(1, 0, 1));
    GlbBuilder builder = triangleGlb();
    builder.document["nodes"][0]["name"] = "rock";
    EXPECT_THAT(loadContent("a.glb", builder.glb()).bears, ElementsAre(1));
    // Nor do several names that all say bare: somebody wants grass on this.
    builder.node({{"mesh", 0}, {"name", "cliff"}});
    Diagnostics diagnostics;
    EXPECT_THAT(loadContent("a.glb", builder.glb(), {}, &diagnostics).bears, ElementsAre(1, 1));
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(BareNames, GiveWayToWhatIsChosen)
{
    const std::string file = namedNodes("scene");
    Diagnostics diagnostics;
    EXPECT_THAT(loadContent("a.glb", file, {.bareNames = false}, &diagnostics).bears,
                ElementsAre(1, 1, 1));
    EXPECT_THAT(loadContent("a.glb", file, {.bearingNodes = {"rocks"}}, &diagnostics).bears,
                ElementsAre(0, 1, 0));
    EXPECT_THAT(diagnostics.warnings(), IsEmpty());
}

TEST(BareNames, OfMaterialsCountBeforeThoseOfNodes)
{
    GroundMesh mesh = loadContent("a.glb", namedNodes("scene"), {.bareNames = false});
    mesh.materials = {{.name = "Grass"}, {.name = "RoadSurface"}, {.name = "paint"}};
    mesh.materialOf = {1, 0, 2};
    Diagnostics diagnostics;
    leaveBareByName(mesh, {}, "a.glb", diagnostics);
    EXPECT_THAT(mesh.bears, ElementsAre(0, 1, 1));
    // Chosen materials are not judged, but nodes still are.
    mesh.bears = {1, 1, 1};
    leaveBareByName(mesh, {.bearingMaterials = {"*"}}, "a.glb", diagnostics);
    EXPECT_THAT(mesh.bears, ElementsAre(1, 0, 1));
}

} // namespace
} // namespace sward::terrain
