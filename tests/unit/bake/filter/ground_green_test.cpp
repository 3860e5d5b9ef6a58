#include "bake/bake.h"
#include "bake/filter/root_filter.h"
#include "bake/mask/ground_green.h"
#include "core/error.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

namespace sward::bake {
namespace {

glm::dvec3 rgb(int red, int green, int blue)
{
    return glm::dvec3(red, green, blue) / 255.0;
}

// The colour of a hue [degrees], saturation and value (Smith 1978).
glm::dvec3 fromHsv(double hue, double saturation, double value)
{
    const auto channel = [&](double offset) {
        const double k = std::fmod(offset + hue / 60.0, 6.0);
        return value - value * saturation * std::max(0.0, std::min({k, 4.0 - k, 1.0}));
    };
    return {channel(5.0), channel(3.0), channel(1.0)};
}

// A level square of `side` metres around the origin, whose image is `image` once.
terrain::GroundMesh painted(double side, terrain::GroundImage image)
{
    terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(side), glm::uvec2(8U)},
                                                    [](double, double) { return 0.0; });
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.uvs[v] = glm::vec2(glm::dvec2(mesh.positions[v].x, mesh.positions[v].z) / side + 0.5);
    mesh.images.push_back(std::move(image));
    mesh.materials[0] = {.name = "painted", .baseColor = glm::vec4(1.0f), .image = 0};
    mesh.materials[0].wrapU = mesh.materials[0].wrapV = terrain::ImageWrap::clamp;
    return mesh;
}

template <typename Texel>
terrain::GroundImage imageOf(std::uint32_t size, Texel texel)
{
    terrain::GroundImage image{"paint", size, size, {}};
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const glm::dvec3 color = texel(x, y);
            for (const double c : {color.x, color.y, color.z, 1.0})
                image.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0 * c)));
        }
    return image;
}

const glm::dvec3 grass = rgb(86, 125, 70);
const glm::dvec3 rock = rgb(128, 126, 120);

TEST(GreenWeight, KnowsGrassFromOtherGround)
{
    for (const glm::dvec3& color : {grass, rgb(40, 60, 25), rgb(150, 160, 60), rgb(95, 100, 55),
                                    rgb(60, 190, 130), rgb(20, 255, 20)})
        EXPECT_GT(greenWeight(color), 0.9) << color.x << " " << color.y << " " << color.z;
    for (const glm::dvec3& color : {rgb(110, 80, 50), rgb(90, 66, 40)}) {
        EXPECT_GT(greenWeight(color), 0.1) << color.x << " " << color.y << " " << color.z;
        EXPECT_LE(greenWeight(color), 0.2) << color.x << " " << color.y << " " << color.z;
    }
    for (const glm::dvec3& color :
         {rock, rgb(60, 60, 62), rgb(194, 178, 128), rgb(237, 201, 175), rgb(210, 180, 140),
          rgb(40, 90, 160), rgb(117, 205, 240), rgb(255, 255, 255), rgb(0, 0, 0), rgb(160, 60, 40),
          rgb(200, 80, 200)})
        EXPECT_LT(greenWeight(color), 0.02) << color.x << " " << color.y << " " << color.z;
}

TEST(GreenWeight, HasSoftEdgesWhereTheyAreStated)
{
    const double value = 0.6;
    // Hue, saturation, weight.
    for (const auto& [hue, saturation, weight] : {std::array{62.0, 0.5, 1.0},
                                                  {160.0, 0.5, 1.0},
                                                  {56.0, 0.5, 0.5},
                                                  {167.5, 0.5, 0.5},
                                                  {175.0, 0.5, 0.0},
                                                  {100.0, 0.25, 1.0},
                                                  {100.0, 0.185, 0.5},
                                                  {100.0, 0.12, 0.0},
                                                  {56.0, 0.185, 0.25}})
        EXPECT_NEAR(greenWeight(fromHsv(hue, saturation, value)), weight, 1e-9)
            << hue << " " << saturation;
}

TEST(GreenWeight, OfEarthHasSoftEdgesWhereTheyAreStated)
{
    // Hue, saturation, value, weight.
    for (const auto& [hue, saturation, value, weight] : {std::array{20.0, 0.45, 0.55, 0.2},
                                                         {50.0, 0.45, 0.55, 0.2},
                                                         {15.0, 0.5, 0.4, 0.1},
                                                         {10.0, 0.5, 0.4, 0.0},
                                                         {350.0, 0.5, 0.4, 0.0},
                                                         {30.0, 0.375, 0.4, 0.1},
                                                         {30.0, 0.3, 0.4, 0.0},
                                                         {30.0, 0.5, 0.625, 0.1},
                                                         {30.0, 0.5, 0.7, 0.0}})
        EXPECT_NEAR(greenWeight(fromHsv(hue, saturation, value)), weight, 1e-9)
            << hue << " " << saturation << " " << value;
}

TEST(GroundGreen, GrowsGrassOnTheGreenHalfOnly)
{
    const terrain::GroundMesh mesh = painted(
        20.0, imageOf(64, [](std::uint32_t x, std::uint32_t) { return x < 32 ? grass : rock; }));
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {parseMask("ground:green")};
    for (const bool invert : {false, true}) {
        settings.masks[0].invert = invert;
        const tests::Trial trial = tests::tryRoots(mesh, settings, 50.0);
        EXPECT_NEAR(trial.share(), 0.5, 0.02);
        EXPECT_EQ(trial.count(Reject::mask), trial.tried - trial.kept.size());
        // The edge is as soft as the footprint and a texel: 0.25 m + 0.3 m.
        for (const RootSample& root : trial.kept)
            EXPECT_TRUE(invert ? root.position.x > -0.6f : root.position.x < 0.6f);
    }
}

TEST(GroundGreen, IsNotFooledByTexels)
{
    // Texels of 2 cm: half are green, and half are bare earth or shade at random.
    const terrain::GroundMesh mesh =
        painted(10.0, imageOf(512, [](std::uint32_t x, std::uint32_t y) {
                    const std::uint32_t hash =
                        (x * 2654435761U ^ y * 2246822519U) * 3266489917U >> 29;
                    return hash < 4 ? grass : hash < 6 ? rgb(70, 60, 45) : rgb(60, 75, 40);
                }));
    const GroundGreen green(mesh, 1.0, false);
    for (const RootSample& root : tests::evenRoots(mesh, 4.0))
        EXPECT_GT(green.at(root), 0.9);
    // Where blades are tiny, texels of this size are ground of its own.
    const GroundGreen tiny(mesh, 0.01, false);
    double least = 1.0;
    for (const RootSample& root : tests::evenRoots(mesh, 4.0))
        least = std::min(least, tiny.at(root));
    EXPECT_LT(least, 0.2);
}

TEST(GroundGreen, MultipliesImageAndBaseColour)
{
    terrain::GroundMesh mesh =
        painted(4.0, imageOf(1, [](std::uint32_t, std::uint32_t) { return rgb(255, 255, 255); }));
    const RootSample root = tests::evenRoots(mesh, 1.0).front();
    EXPECT_EQ(GroundGreen(mesh, 1.0, false).at(root), 0.0);
    mesh.materials[0].baseColor = glm::vec4(0.1f, 0.3f, 0.05f, 1.0f);
    EXPECT_EQ(GroundGreen(mesh, 1.0, false).at(root), 1.0);
    // Vertex colours count where there is no image, unless they are a mask.
    mesh.hasColors = true;
    mesh.colors.assign(mesh.colors.size(), glm::vec4(1.0f, 0.0f, 1.0f, 1.0f));
    EXPECT_EQ(GroundGreen(mesh, 1.0, false).at(root), 1.0);
    mesh.materials[0].image = terrain::GroundMaterial::noImage;
    EXPECT_EQ(GroundGreen(mesh, 1.0, false).at(root), 0.0);
    EXPECT_EQ(GroundGreen(mesh, 1.0, true).at(root), 1.0);
}

TEST(GroundGreen, OfASpeciesRulesOnlyThatSpecies)
{
    const terrain::GroundMesh mesh = painted(
        20.0, imageOf(64, [](std::uint32_t x, std::uint32_t) { return x < 32 ? grass : rock; }));
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow.species.emplace_back();
    settings.meadow.species[1].habitat.masks = {parseMask("ground:green:invert")};
    settings.meadow.species[1].priority = 1;
    EXPECT_TRUE(needsGreen(settings));
    const tests::Place place(mesh, settings);
    for (const RootSample& root : tests::evenRoots(mesh, 1.0)) {
        const double onRock = root.position.x > 0.6f ? 1.0 : root.position.x < -0.6f ? 0.0 : -1.0;
        if (onRock >= 0.0) {
            EXPECT_EQ(place.filter().standAt(root).shares.share[1], onRock);
        }
    }
}

TEST(GroundGreen, NeedsColours)
{
    terrain::GroundMesh mesh = meshes::square(2.0);
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {parseMask("ground:green")};
    const auto complains = [&] {
        try {
            checkGround(mesh, settings);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            return true;
        }
        return false;
    };
    EXPECT_TRUE(complains()) << "the earth of ground without a material is nobody's choice";
    mesh.materials[0].baseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
    EXPECT_TRUE(complains()) << "neither is an exporter's grey";
    mesh.materials[0].baseColor = glm::vec4(0.1f, 0.3f, 0.05f, 1.0f);
    EXPECT_FALSE(complains());
    mesh.materials[0].baseColor = glm::vec4(1.0f);
    mesh.hasColors = true;
    EXPECT_FALSE(complains());
    settings.masks.push_back(parseMask("vertex-color:R"));
    EXPECT_TRUE(complains()) << "vertex colours that are a mask are no colours";
}

TEST(GreenShares, AreThoseOfTheArea)
{
    // A quarter is green, a quarter earth and half rock.
    const terrain::GroundMesh mesh =
        painted(40.0, imageOf(64, [](std::uint32_t x, std::uint32_t y) {
                    return x < 32 ? rock : y < 32 ? grass : rgb(110, 80, 50);
                }));
    const std::optional<GreenShares> shares = greenShares(mesh, 1.0, false);
    ASSERT_TRUE(shares);
    EXPECT_NEAR(shares->green, 0.25, 0.012);
    EXPECT_NEAR(shares->bare, 0.75, 0.012);
    EXPECT_TRUE(shares->matter());
    EXPECT_FALSE((GreenShares{.green = 0.09, .bare = 0.91}).matter());
    EXPECT_FALSE((GreenShares{.green = 0.91, .bare = 0.09}).matter());
    EXPECT_FALSE((GreenShares{.green = 0.37, .bare = 0.37}).matter());
    EXPECT_FALSE(greenShares(meshes::square(2.0), 1.0, false));
}

// The texts of the default masks of a square of 40 m, green west of `edge` and `other` east of it.
std::vector<std::string> chosenFor(std::uint32_t edge, glm::dvec3 other,
                                   const BakeSettings& settings = tests::plainSettings(1.0))
{
    const terrain::GroundMesh mesh = painted(40.0, imageOf(64, [&](std::uint32_t x, std::uint32_t) {
                                                 return x < edge ? grass : other;
                                             }));
    std::vector<std::string> texts;
    for (const Mask& mask : defaultMasks(mesh, settings))
        texts.push_back(textOf(mask));
    return texts;
}

TEST(DefaultMasks, AreTheGreenWhereTheGroundIsClearlyGreenAndClearlyNot)
{
    const glm::dvec3 brown = rgb(110, 80, 50);
    const std::vector<std::string> green{"ground:green"};
    const std::vector<std::string> none;
    EXPECT_EQ(chosenFor(32, rock), green);
    EXPECT_EQ(chosenFor(32, brown), green);
    EXPECT_EQ(chosenFor(10, rock), green);
    EXPECT_EQ(chosenFor(54, rock), green);
    EXPECT_EQ(chosenFor(64, rock), none) << "all green";
    EXPECT_EQ(chosenFor(0, brown), none) << "all brown";
    EXPECT_EQ(chosenFor(4, rock), none) << "a few green specks";
    EXPECT_EQ(chosenFor(60, rock), none) << "a few rocks";
    // Between grass and sand; a third of the ground is neither.
    EXPECT_EQ(chosenFor(20, fromHsv(55.0, 0.4, 0.7)), none);
    EXPECT_TRUE(defaultMasks(meshes::square(2.0), tests::plainSettings(1.0)).empty())
        << "no colours";
}

TEST(DefaultMasks, AreThoseOfVertexColoursToo)
{
    terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(40.0), glm::uvec2(16U)},
                                                    [](double, double) { return 0.0; });
    mesh.materials[0].baseColor = glm::vec4(1.0f);
    mesh.hasColors = true;
    mesh.colors.clear();
    for (const glm::vec3& position : mesh.positions)
        mesh.colors.emplace_back(position.x < 0.0f ? glm::vec4(0.1f, 0.3f, 0.05f, 1.0f)
                                                   : glm::vec4(0.3f, 0.3f, 0.3f, 1.0f));
    EXPECT_EQ(defaultMasks(mesh, tests::plainSettings(1.0)).size(), 1u);
}

TEST(DefaultMasks, AreNoneWhereOneIsNamed)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.masks = {parseMask("material-texture:R")};
    EXPECT_TRUE(chosenFor(32, rock, settings).empty());
    settings = tests::plainSettings(1.0);
    settings.meadow.species.back().habitat.masks = {parseMask("ground:green:invert")};
    EXPECT_TRUE(chosenFor(32, rock, settings).empty());
}

TEST(Masks, NameTheGroundsGreen)
{
    for (const char* text : {"ground:green", "ground:green:invert"}) {
        const std::optional<Mask> mask = readMask(text);
        ASSERT_TRUE(mask) << text;
        EXPECT_EQ(mask->source, Mask::Source::groundGreen);
        EXPECT_EQ(textOf(*mask), text);
    }
    for (const char* text : {"ground:blue", "ground", "ground:", "ground:green:R", "ground:Green"})
        EXPECT_FALSE(readMask(text)) << text;
    try {
        parseMask("ground:blue");
        FAIL() << "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_NE(std::string(error.what()).find("ground:blue"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("ground:green"), std::string::npos);
    }
}

} // namespace
} // namespace sward::bake
