#include "core/error.h"
#include "field/measure/blade_rotation.h"
#include "interchange/instance_attributes.h"
#include "interchange/instances.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>

namespace sward::interchange {
namespace {

using test::makeField;
using test::Surface;

// Up-vectors of every direction, with the poles and axes among them.
std::vector<glm::vec3> directions()
{
    std::vector<glm::vec3> all = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                  {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (std::uint32_t bits = 0; bits < 65536; bits += 251)
        all.push_back(shared::decodeOctahedral(bits));
    return all;
}

TEST(Orientation, TurnsYToTheUpVectorAndZToTheFront)
{
    for (const glm::vec3& up : directions())
        for (int step = 0; step < 256; step += 15) {
            const float facing = float(step) * shared::twoPi / 256.0f;
            const glm::quat turn = field::bladeRotation(up, facing);
            const glm::vec3 front = shared::frontOf(up, shared::widthAxis(up, facing));
            EXPECT_LT(glm::distance(turn * glm::vec3(0, 1, 0), up), 2e-6f);
            EXPECT_LT(glm::distance(turn * glm::vec3(0, 0, 1), front), 2e-6f);
            EXPECT_LT(glm::distance(turn * glm::vec3(1, 0, 0), -shared::widthAxis(up, facing)),
                      2e-6f);
        }
}

TEST(Orientation, IsAUnitQuaternionWithPositiveW)
{
    for (const glm::vec3& up : directions())
        for (const float facing : {0.0f, 1.0f, 3.1415927f, 6.2f}) {
            const glm::quat turn = field::bladeRotation(up, facing);
            EXPECT_NEAR(glm::length(turn), 1.0f, 2e-7f);
            EXPECT_GE(turn.w, 0.0f);
        }
}

TEST(Instances, StandWhereTheBladesStand)
{
    const field::Field field =
        makeField({.surface = Surface::cloud, .blades = 9000, .extent = 300.0f});
    const field::FieldView view = field::viewOf(field);
    std::set<std::uint64_t> ids;
    for (const BladeGroup& group : groupBlades(view, 1000)) {
        const std::vector<Instance> instances = instancesOf(view, group, "f");
        EXPECT_EQ(instances.size(), group.bladeCount);
        for (const Instance& instance : instances) {
            ids.insert(instance.id);
            // A place below 200 m rounds to 8 µm.
            EXPECT_LT(glm::distance(group.place + glm::dvec3(instance.place),
                                    glm::dvec3(instance.blade.root)),
                      1.5e-5);
        }
    }
    EXPECT_EQ(ids.size(), 9000U);
}

TEST(Instances, HaveTheirPlaceInAFileWithoutKeysAsTheirId)
{
    field::Field field = makeField({.blades = 600});
    field.keys.clear();
    const field::FieldView view = field::viewOf(field);
    const std::vector<Instance> instances = instancesOf(view, groupBlades(view)[0], "f");
    for (std::size_t i = 0; i < instances.size(); ++i)
        EXPECT_EQ(instances[i].id, i);
}

TEST(Instances, OfNumbersBeyondAllBoundsAreRefused)
{
    field::Field field = makeField({.blades = 600});
    field.patches[0].heightStep = std::numeric_limits<float>::max();
    const field::FieldView view = field::viewOf(field);
    EXPECT_THROW(instancesOf(view, groupBlades(view)[0], "f"), Error);
}

TEST(Instances, MeansAreTheSpeciesOwn)
{
    field::Field field = makeField({.blades = 4000});
    field.species.push_back(field.species[0]);
    field.species.push_back(field.species[0]);
    // Every second blade becomes one of species 1 that does not bend.
    for (std::size_t i = 0; i < field.blades.size(); i += 2) {
        field.blades[i].look |= 1U << 21;
        field.blades[i].shape |= 63U << 22;
    }
    const std::vector<MeanBlade> means = meanBlades(field::viewOf(field));
    ASSERT_EQ(means.size(), 3U);
    EXPECT_NEAR(means[0].stiffness, 0.55f, 0.02f);
    EXPECT_FLOAT_EQ(means[1].stiffness, 1.0f);
    EXPECT_FLOAT_EQ(means[2].stiffness, MeanBlade().stiffness);
    EXPECT_FLOAT_EQ(means[2].slenderness, MeanBlade().slenderness);
}

TEST(InstanceAttributes, AreAlignedAndHaveNoUnsignedInt)
{
    std::set<std::string> names;
    for (const InstanceAttribute& attribute : instanceAttributes()) {
        EXPECT_EQ(attribute.bytes % 4, 0U) << attribute.name;
        EXPECT_NE(attribute.componentType, 5125) << attribute.name;
        names.insert(attribute.name);
    }
    EXPECT_EQ(names.size(), instanceAttributes().size());
}

TEST(InstanceAttributes, SplitTheIdIntoSixteenBitsEach)
{
    Instance instance = {};
    instance.id = 0x001f'edcb'a987'6543ULL;
    for (const InstanceAttribute& attribute : instanceAttributes())
        if (std::string(attribute.name) == "_ROOT_ID") {
            std::byte bytes[8];
            attribute.store(instance, bytes);
            std::uint16_t words[4];
            std::memcpy(words, bytes, sizeof words);
            EXPECT_EQ(words[0], 0x6543);
            EXPECT_EQ(words[1], 0xa987);
            EXPECT_EQ(words[2], 0xedcb);
            EXPECT_EQ(words[3], 0x001f);
        }
}

} // namespace
} // namespace sward::interchange
