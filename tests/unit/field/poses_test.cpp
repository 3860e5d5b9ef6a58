#include "core/error.h"
#include "field/organs.h"
#include "field/poses/blade_poses.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/physics.h"
#include "support/fields/fields.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace sward::field {
namespace {

// A field with stalks that bear three ribbons each.
field::Field plants()
{
    field::Field meadow = test::makeField({.blades = 40, .origin = glm::dvec3(4e5, 30.0, -7e5)});
    field::Organ leaf;
    leaf.count = 3;
    leaf.place = {0.3f, 0.9f};
    meadow.species[0].organs = {leaf};
    field::numberOrgans(meadow.species, "test");
    for (const shared::Patch& cell : meadow.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            // Every fourth one is a stalk; the next three have its bytes but for their number.
            const std::uint32_t stalk = cell.firstBlade + i / 4 * 4;
            shared::PackedBlade& bits = meadow.blades[cell.firstBlade + i];
            bits = meadow.blades[stalk];
            bits.look = (bits.look & 0x00ffffffU) | ((i % 4) << 24U);
        }
    return meadow;
}

class Poses : public testing::Test {
protected:
    void SetUp() override
    {
        folder_ =
            std::filesystem::temp_directory_path() / ("sward-poses-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    // What the viewer's dump has: world places with nine decimals.
    std::filesystem::path dump(const field::Field& meadow, const std::vector<BladePose>& poses,
                               const std::function<void(std::string&)>& change = {}) const
    {
        std::string text = "id,x,y,z,v1x,v1y,v1z,v2x,v2y,v2z,ux,uy,uz,eta,lod_width,cull_result\n";
        const field::FieldView view = field::viewOf(meadow);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            text += fmt::format("{}", view.idOf(i));
            for (const glm::vec3& v : {poses[i].v0, poses[i].v1, poses[i].v2}) {
                const glm::dvec3 world = meadow.origin + glm::dvec3(v);
                text += fmt::format(",{:.9f},{:.9f},{:.9f}", world.x, world.y, world.z);
            }
            text += ",0,1,0,0,0,drawn\n";
        }
        if (change)
            change(text);
        const std::filesystem::path path = folder_ / "d.csv";
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }

    std::string refusal(const field::Field& meadow, const std::filesystem::path& path) const
    {
        try {
            readPoses(field::viewOf(meadow), path);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "";
    }

    std::filesystem::path folder_;
};

TEST_F(Poses, RestIsWhereABladeMovesNoMore)
{
    const field::Field meadow = test::makeField({.blades = 200});
    const std::vector<BladePose> poses = restingPoses(field::viewOf(meadow));
    shared::Gravity gravity = {};
    gravity.direction = meadow.defaults.gravityDirection;
    gravity.strength = meadow.defaults.gravityStrength;
    gravity.forward = shared::forwardShare;
    for (const shared::Patch& cell : meadow.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const BladePose& pose = poses[cell.firstBlade + i];
            const shared::Blade blade =
                shared::unpackBlade(meadow.blades[cell.firstBlade + i], cell);
            const glm::vec3 front =
                shared::frontOf(blade.up, shared::widthAxis(blade.up, blade.facing));
            const glm::vec3 tip = (pose.v2 - pose.v0) / blade.height;
            const glm::vec3 moved = shared::relaxTip(blade, front, gravity, glm::vec3(0.0f),
                                                     meadow.defaults.recovery, tip, 0.0f, 0.5f);
            EXPECT_LT(glm::length(glm::normalize(moved) - glm::normalize(tip)), 2e-3f);
        }
}

TEST_F(Poses, OfADumpAreThoseOfTheField)
{
    const field::Field meadow = plants();
    const std::vector<BladePose> resting = restingPoses(field::viewOf(meadow));
    const std::vector<BladePose> read = readPoses(field::viewOf(meadow), dump(meadow, resting));
    ASSERT_EQ(read.size(), resting.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_LT(glm::length(read[i].v2 - resting[i].v2), 1e-6f);
        // A ribbon's axis follows from its stalk.
        EXPECT_LT(glm::length(read[i].axis - resting[i].axis), 1e-3f) << i;
    }
}

TEST_F(Poses, OfAnotherFileAreRefusedByLine)
{
    const field::Field meadow = test::makeField({.blades = 20});
    const std::vector<BladePose> poses = restingPoses(field::viewOf(meadow));
    const auto with = [&](const std::function<void(std::string&)>& change) {
        return refusal(meadow, dump(meadow, poses, change));
    };
    EXPECT_NE(with([](std::string& text) { text = "id,height\n1,2\n"; }).find("line 1"),
              std::string::npos);
    EXPECT_NE(with([](std::string& text) { text += "7,0,0,0\n"; }).find("only 20 blades"),
              std::string::npos);
    EXPECT_NE(with([](std::string& text) { text.resize(text.size() / 2); }).find("d.csv"),
              std::string::npos);
    EXPECT_NE(
        with([](std::string& text) { text.replace(text.find("\n") + 1, 1, "x"); }).find("line 2"),
        std::string::npos);
    EXPECT_NE(with([](std::string& text) {
                  const std::size_t row = text.find("\n") + 1;
                  text.insert(text.find(",", row) + 1, "nan,");
              }).find("line 2"),
              std::string::npos);
}

} // namespace
} // namespace sward::field
