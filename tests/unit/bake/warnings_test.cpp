#include "bake/filter/plain_masks.h"
#include "bake/whole/report_totals.h"
#include "bake/whole/warnings.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace sward::bake {
namespace {

// All warnings of a bake, as one text.
std::string warningsOf(const terrain::GroundMesh& mesh, const BakeSettings& settings)
{
    const tests::Trial trial = tests::tryRoots(mesh, settings, 20.0);
    RootCounts counts;
    counts.kept = trial.kept.size();
    counts.proposed = trial.tried;
    counts.rejected = trial.rejected;
    for (const RootSample& root : trial.kept) {
        const glm::dvec3 up = settings.groundUp.at(mesh.origin + glm::dvec3(root.position));
        counts.undersides += std::uint64_t(glm::dot(glm::dvec3(root.normal), up) < 0.0);
    }
    Diagnostics diagnostics;
    warnAboutRoots(counts, reportOf(mesh, settings, 1).input, settings, Plan(), diagnostics);
    std::string all;
    for (const std::string& warning : diagnostics.warnings())
        all += warning + "\n";
    return all;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(Warnings, AreSilentWhereNothingIsWrong)
{
    EXPECT_EQ(warningsOf(meshes::square(10.0), tests::plainSettings(1.0)), "");
}

TEST(Warnings, NameTheOptionThatLeavesNothing)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.slope = {20.0, 90.0, 0.0};
    EXPECT_TRUE(has(warningsOf(meshes::square(10.0), settings), "slope 2000 (--slope)"));
    settings = tests::plainSettings(1.0);
    settings.altitude = {5.0, 9.0, 0.0};
    const std::string text = warningsOf(meshes::square(10.0, 2.5), settings);
    EXPECT_TRUE(has(text, "altitude 2000 (--altitude)")) << text;
    EXPECT_TRUE(has(text, "from 2.5 to 2.5 m")) << text;
}

TEST(Warnings, NameAnAmountThatGivesSomeBlades)
{
    const BakeSettings settings = tests::plainSettings(1.0);
    Plan plan;
    plan.area = 1e-4;
    plan.density = 200.0;
    plan.expected = 0.02;
    Diagnostics diagnostics;
    warnAboutRoots(RootCounts(), Report::Input(), settings, plan, diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    const std::string text = diagnostics.warnings()[0];
    EXPECT_TRUE(has(text, "0.02 blades were expected on 0.0001 m² at 200 per m²")) << text;
    EXPECT_TRUE(has(text, "--density 1e+06 or --count 100")) << text;
}

TEST(Warnings, SayWhyHardlyAnythingGrows)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.border = parseSoftMinimum("--border", "4.8");
    const std::string text = warningsOf(meshes::square(10.0), settings);
    EXPECT_TRUE(has(text, "only 0.")) << text;
    EXPECT_TRUE(has(text, "--border")) << text;
}

TEST(Warnings, TellUndersidesFromAMeshInsideOut)
{
    const BakeSettings settings = tests::plainSettings(1.0);
    EXPECT_TRUE(has(warningsOf(meshes::sphere(64, 2.0), settings), "--slope 0:90"));
    terrain::GroundMesh turned = meshes::square(10.0);
    for (glm::uvec3& t : turned.triangles)
        std::swap(t.y, t.z);
    for (glm::vec3& normal : turned.normals)
        normal = -normal;
    EXPECT_TRUE(has(warningsOf(turned, settings), "--sides back"));
}

TEST(Warnings, PointOutWhatDoesNothing)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.excluded = {{"pond.glb", 0.0,
                          std::make_shared<terrain::GroundMesh>(
                              meshes::moved(meshes::cube(2.0), {0.0, 0.0, 4000.0}))}};
    settings.border = parseSoftMinimum("--border", "2");
    const std::string text = warningsOf(meshes::cube(4.0), settings);
    EXPECT_TRUE(has(text, "--exclude pond.glb: excludes nothing")) << text;
    EXPECT_TRUE(has(text, "3999")) << text;
    EXPECT_TRUE(has(text, "--border rejects nothing")) << text;
}

TEST(Warnings, SayWhichMaskIsPlain)
{
    // Of three masks one is white, one is black on all that bears, and one is neither.
    terrain::GroundMesh ground = meshes::grid(4, 10.0);
    ground.hasColors = true;
    for (glm::vec4& color : ground.colors)
        color = glm::vec4(1.0f, 0.0f, 0.5f, 1.0f);
    ground.bears[7] = 0;
    const glm::uvec3 bare = ground.triangles[7];
    ground.colors[bare.x].z = 0.0f;
    BakeSettings settings = tests::plainSettings(1.0);
    for (int channel = 0; channel < 3; ++channel)
        settings.masks.push_back({.channel = channel});
    settings.meadow.species[0].habitat.masks = {{.channel = 1, .invert = true}};
    Diagnostics diagnostics;
    warnOfPlainMasks(ground, settings, diagnostics);
    const std::vector<std::string>& warnings = diagnostics.warnings();
    ASSERT_EQ(warnings.size(), 3U);
    EXPECT_TRUE(has(warnings[0], "--mask vertex-color:R rejects nothing")) << warnings[0];
    EXPECT_TRUE(has(warnings[1], "--mask vertex-color:G rejects everything")) << warnings[1];
    EXPECT_TRUE(has(warnings[2], "mask vertex-color:G:invert rejects nothing")) << warnings[2];

    // A single corner that bears and differs ends it.
    for (const std::uint32_t corner : {ground.triangles[0].x})
        ground.colors[corner] = glm::vec4(0.9f, 0.1f, 0.5f, 1.0f);
    Diagnostics none;
    warnOfPlainMasks(ground, settings, none);
    EXPECT_TRUE(none.warnings().empty());
}

} // namespace
} // namespace sward::bake
