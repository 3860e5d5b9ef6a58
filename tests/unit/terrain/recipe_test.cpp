#include "core/error.h"
#include "support/meshes.h"
#include "terrain/recipe.h"
#include "unit/terrain/gltf/glb_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string messageOf(const std::string& recipe)
{
    try {
        loadContent("r.json", recipe);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << recipe;
        return error.what();
    }
    return "";
}

TEST(Recipe, KnowsTheBuiltInTerrains)
{
    EXPECT_THAT(builtInNames(), ElementsAre("arch", "dunes", "hills", "plane", "sphere", "torus"));
    for (const std::string& name : builtInNames()) {
        Diagnostics diagnostics;
        const GroundMesh mesh = load(name, {}, diagnostics);
        EXPECT_THAT(mesh.bears, testing::Each(1)) << name;
        EXPECT_THAT(diagnostics.warnings(), testing::IsEmpty()) << name;
    }
}

TEST(Recipe, HasBuiltInsWithTheDefaultsOfTheirKind)
{
    for (const std::string& name : builtInNames()) {
        Diagnostics diagnostics;
        EXPECT_EQ(contentHash(load(name, {}, diagnostics)),
                  contentHash(loadContent("r.json", "{\"kind\": \"" + name + "\"}")))
            << name;
    }
}

TEST(Recipe, AppliesItsParameters)
{
    const GroundMesh mesh =
        loadContent("r.json", R"({"kind": "sphere", "radius": 2, "segments": 16, "rings": 8})");
    EXPECT_EQ(mesh.triangles.size(), 2U * 16U * 7U);
    EXPECT_NEAR(static_cast<double>(mesh.bounds().high.y), 2.0, 1e-6);
}

TEST(Recipe, PairsOfCountsAreWhole)
{
    EXPECT_THAT(messageOf(R"({"kind": "hills", "cells": [4.9, 4]})"),
                testing::HasSubstr("cells: 4.9 is not a whole number"));
    EXPECT_THAT(messageOf(R"({"kind": "heightmap", "file": "a.r16", "size": [3, 4.5]})"),
                testing::HasSubstr("size: 4.5 is not a whole number"));
}

TEST(Recipe, ReadsAMeshFromItsFolderInItsUnits)
{
    const ScratchFolder folder;
    folder.write("parts/tile.obj", "v 0 0 0\nv 0 100 0\nv 100 0 0\nf 1 3 2\n");
    const std::string recipe = folder.write(
        "parts/r.json", R"({"kind": "mesh", "file": "tile.obj", "up_axis": "z", "units": "cm"})");
    Diagnostics diagnostics;
    const GroundMesh mesh = load(recipe, {}, diagnostics);
    EXPECT_NEAR(mesh.area(0), 0.5, 1e-6);
    EXPECT_GT(mesh.faceNormal(0).y, 0.99);
}

TEST(Recipe, ProposesTheNearestWord)
{
    EXPECT_THAT(messageOf(R"({"kind": "sphere", "radios": 2})"), HasSubstr("radius"));
}

TEST(Recipe, RefusesWhatMakesNoGround)
{
    EXPECT_THAT(messageOf(R"({"kind": "cone"})"), HasSubstr("cone"));
    EXPECT_THAT(messageOf(R"({"kind": "sphere", "rings": 7})"), HasSubstr("rings"));
    EXPECT_THAT(messageOf(R"({"kind": "sphere", "radius": -1})"), HasSubstr("radius"));
    EXPECT_THAT(messageOf(R"({"kind": "torus", "minor_radius": 9})"), HasSubstr("minor_radius"));
    EXPECT_THAT(messageOf(R"({"kind": "arch", "thickness": 9})"), HasSubstr("thickness"));
    EXPECT_THAT(messageOf(R"({"kind": "mesh"})"), HasSubstr("file"));
    EXPECT_THAT(messageOf(R"({"kind": "mesh", "file": "r.json"})"), HasSubstr("recipe"));
    EXPECT_THAT(messageOf(R"({"kind": "plane", "cells": [0, 3]})"), HasSubstr("cells"));
    EXPECT_THAT(messageOf(R"(["plane"])"), HasSubstr("object"));
    EXPECT_THAT(messageOf("{"), HasSubstr("r.json"));
}

} // namespace
} // namespace sward::terrain
