#include "core/error.h"
#include "field/join.h"
#include "field/seeds/sower.h"
#include "field/verify.h"
#include "support/fields/fields.h"
#include "unit/field/sample_field.h"
#include "unit/field/sample_seeds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace sward::field {
namespace {

constexpr std::uint32_t speciesBits = 7u << 21u;

Field fieldAt(const glm::dvec3& origin, std::size_t blades, std::uint64_t seed)
{
    return test::makeField({.blades = blades, .extent = 40.0f, .origin = origin, .seed = seed});
}

std::vector<Member> membersOf(const std::vector<Field>& fields)
{
    std::vector<Member> members;
    for (const Field& field : fields)
        members.push_back({viewOf(field), "field " + std::to_string(members.size())});
    return members;
}

std::string complaintOf(const std::vector<Field>& fields)
{
    try {
        join(membersOf(fields));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return {};
}

TEST(JoinedFields, AreAFieldThatHasEveryBladeOnceBitByBit)
{
    const std::vector<Field> fields{fieldAt({0, 0, 0}, 3000, 1), fieldAt({64, 0, -32}, 1000, 2),
                                    tests::sampleField()};
    std::vector<Member> members = membersOf(fields);
    // At the smallest allowed distance: the sample has another position.
    members[2].view.origin = glm::dvec3(0.0, 32.0, 0.0);
    const JoinedFields joined = join(members);
    const FieldView view = viewOf(joined.field);
    verify(view, "joined");
    EXPECT_EQ(view.blades.size(), 4015U);
    ASSERT_EQ(joined.sources.size(), view.patches.size());

    std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
    for (std::size_t p = 0; p < view.patches.size(); ++p) {
        const PatchSource source = joined.sources[p];
        if (source.member == PatchSource::none) {
            EXPECT_EQ(view.patches[p].bladeCount, 0U);
            continue;
        }
        const FieldView& own = members[source.member].view;
        const shared::Patch& patch = own.patches[source.patch];
        ++seen[{source.member, source.patch}];
        ASSERT_EQ(view.patches[p].bladeCount, patch.bladeCount);
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const std::size_t to = view.patches[p].firstBlade + i;
            const std::size_t from = patch.firstBlade + i;
            shared::PackedBlade blade = view.blades[to];
            const std::uint32_t slot = blade.look >> 21u & 7u;
            const std::uint32_t ownSlot = own.blades[from].look >> 21u & 7u;
            EXPECT_EQ(view.species[slot].name, own.species[ownSlot].name);
            blade.look = (blade.look & ~speciesBits) | (own.blades[from].look & speciesBits);
            EXPECT_EQ(std::memcmp(&blade, &own.blades[from], sizeof blade), 0);
            EXPECT_EQ(bladeId(view.keys[to]), bladeId(own.keys[from]));
        }
    }
    std::size_t patches = 0;
    for (const Member& member : members)
        patches += member.view.patches.size();
    EXPECT_EQ(seen.size(), patches);
    for (const auto& [source, times] : seen)
        EXPECT_EQ(times, 1);
}

TEST(JoinedFields, KeepTheWorldPlacesOfBladesAndGround)
{
    // Not a multiple of 32 m, far from the world's origin, nearly at the largest allowed distance.
    const std::vector<Field> fields{fieldAt({1e6, 0, 0}, 500, 1),
                                    fieldAt({1e6 + 12345.678, -98.7, 16300.3}, 500, 2)};
    const JoinedFields joined = join(membersOf(fields));
    const FieldView view = viewOf(joined.field);
    EXPECT_EQ(view.origin, fields[0].origin);
    for (std::size_t p = 0; p < view.patches.size(); ++p) {
        const PatchSource source = joined.sources[p];
        if (source.member == PatchSource::none)
            continue;
        const Field& own = fields[source.member];
        const shared::Patch& patch = own.patches[source.patch];
        const double bound = source.member == 0 ? 0.0 : 0.0015; // position and its rounding
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade there =
                shared::unpackBlade(view.blades[view.patches[p].firstBlade + i], view.patches[p]);
            const shared::Blade here = shared::unpackBlade(own.blades[patch.firstBlade + i], patch);
            EXPECT_LE(glm::distance(view.origin + glm::dvec3(there.root),
                                    own.origin + glm::dvec3(here.root)),
                      bound);
            EXPECT_EQ(there.height, here.height);
            // The box moved with its content.
            EXPECT_TRUE(glm::all(glm::lessThanEqual(view.patches[p].boundsLow, there.root)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(there.root, view.patches[p].boundsHigh)));
        }
    }
    const std::size_t first = fields[0].ground.vertices.size();
    ASSERT_EQ(view.ground->vertices.size(), first + fields[1].ground.vertices.size());
    for (std::size_t v = first; v < view.ground->vertices.size(); ++v)
        EXPECT_LE(glm::distance(view.origin + glm::dvec3(view.ground->vertices[v].position),
                                fields[1].origin +
                                    glm::dvec3(fields[1].ground.vertices[v - first].position)),
                  0.0015);
}

TEST(JoinedFields, HaveBoxesThatHoldThoseBelow)
{
    std::vector<Field> fields;
    for (int i = 0; i < 20; ++i)
        fields.push_back(
            fieldAt({37.3 * i, 0.1 * i, -512.7 * i}, 300, 1 + static_cast<std::uint64_t>(i)));
    const JoinedFields joined = join(membersOf(fields));
    const std::vector<shared::Patch>& patches = joined.field.patches;
    verify(viewOf(joined.field), "joined");
    std::size_t above = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        above += joined.sources[p].member == PatchSource::none ? 1U : 0U;
        if (p == 0 || joined.sources[patches[p].parent].member != PatchSource::none)
            continue;
        const shared::Patch& parent = patches[patches[p].parent];
        EXPECT_TRUE(glm::all(glm::lessThanEqual(parent.boundsLow, patches[p].boundsLow)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(patches[p].boundsHigh, parent.boundsHigh)));
    }
    EXPECT_EQ(above, 4U) << "20 fields under three nodes under one";
}

TEST(JoinedFields, KeepTheGroundsTrianglesMaterialsAndImages)
{
    const std::vector<Field> fields{tests::sampleField(), tests::sampleField()};
    const JoinedFields joined = join(membersOf(fields));
    const DisplayGround& own = fields[0].ground;
    const DisplayGround& ground = joined.field.ground;
    EXPECT_EQ(ground.ranges.size(), 2 * own.ranges.size());
    EXPECT_EQ(ground.images.size(), 2 * own.images.size());
    for (std::size_t r = 0; r < ground.ranges.size(); ++r) {
        const GroundRange& range = ground.ranges[r];
        EXPECT_TRUE(r == 0 || ground.ranges[r - 1].level <= range.level);
        for (std::uint32_t i = 0; i < range.indexCount; ++i) {
            // Everything of the second follows everything of the first.
            const bool isSecond = range.firstIndex >= own.indices.size();
            EXPECT_EQ(ground.indices[range.firstIndex + i] >= own.vertices.size(), isSecond);
            EXPECT_EQ(range.material >= own.materials.size(), isSecond);
        }
    }
}

TEST(JoinedFields, ShareSpeciesThatAreAlike)
{
    std::vector<Field> fields{tests::sampleField(), tests::sampleField()};
    EXPECT_EQ(join(membersOf(fields)).field.species.size(), 2U);
    fields[1].species[0].look.gloss += 0.1f;
    const JoinedFields joined = join(membersOf(fields));
    EXPECT_EQ(joined.field.species.size(), 3U);
    EXPECT_EQ(joined.field.species[1].name, fields[0].species[1].name);
}

TEST(JoinedFields, OfTooManySpeciesAreRefusedByName)
{
    std::vector<Field> fields;
    for (int i = 0; i < 5; ++i) {
        fields.push_back(tests::sampleField());
        for (Species& one : fields.back().species)
            one.name += std::to_string(i);
    }
    EXPECT_NE(complaintOf(fields).find("field 4"), std::string::npos);
    fields.pop_back();
    EXPECT_EQ(complaintOf(fields), "");
}

TEST(JoinedFields, ThatLieTooFarApartAreRefusedByName)
{
    EXPECT_EQ(complaintOf({fieldAt({0, 0, 0}, 10, 1), fieldAt({16300, 0, 0}, 10, 2)}), "");
    EXPECT_NE(
        complaintOf({fieldAt({0, 0, 0}, 10, 1), fieldAt({16400, 0, 0}, 10, 2)}).find("field 1"),
        std::string::npos);
}

TEST(JoinedFields, MayBeEmptyOrAloneOrWithoutKeys)
{
    std::vector<Field> fields{test::emptyField(), fieldAt({0, 0, 0}, 300, 1)};
    JoinedFields joined = join(membersOf(fields));
    verify(viewOf(joined.field), "one of two is empty");
    EXPECT_EQ(joined.field.blades.size(), 300U);
    verify(viewOf(join(membersOf({test::emptyField()})).field), "empty");

    fields.push_back(fieldAt({0, 0, 0}, 300, 2));
    fields[1].keys.clear();
    joined = join(membersOf(fields));
    verify(viewOf(joined.field), "one has no keys");
    EXPECT_TRUE(joined.field.keys.empty());
}

TEST(JoinedFields, TellWhereTheyComeFrom)
{
    std::vector<Field> fields{tests::sampleField(), tests::sampleField()};
    fields[0].provenance = R"({"a":1})";
    fields[1].provenance = R"({"b":2})";
    fields[1].copyright = "CC-BY";
    const JoinedFields joined = join(membersOf(fields));
    EXPECT_EQ(joined.field.provenance, R"({"fields":[{"a":1},{"b":2}]})");
    EXPECT_EQ(joined.field.copyright, "CC0\nCC-BY");
    EXPECT_EQ(joined.field.defaults.cameras.size(), 2 * fields[0].defaults.cameras.size());
}

TEST(JoinedFields, KeepTheirSeeds)
{
    // Another field before one with seeds; a third one with seeds of the same meadow elsewhere.
    std::vector<Field> fields{fieldAt({64, 0, -32}, 100, 1), tests::seeded(tests::sampleField()),
                              tests::seeded(tests::sampleField())};
    fields[1].origin = {0.0, 32.0, -64.0};
    fields[2].origin = {96.0, 0.0, 0.0};
    std::vector<Member> members = membersOf(fields);
    const Field joined = join(members).field;
    verify(viewOf(joined), "joined");
    ASSERT_TRUE(joined.seeds);
    const SeedsView& seeds = joined.seeds->view;
    ASSERT_EQ(seeds.cells.size(), 2U);
    EXPECT_EQ(seeds.meadow->species.size(), joined.species.size());
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 from =
            joined.origin + 32.0 * glm::dvec3(seeds.cells[i].cell[0], seeds.cells[i].cell[1],
                                              seeds.cells[i].cell[2]);
        const Field& own = fields[1 + i];
        EXPECT_EQ(from, own.origin + 32.0 * glm::dvec3(-1.0, 0.0, 2.0));
        // It grows the same blades, with its own species.
        const SeedCell cell = readSeedCell(seeds, i, "joined");
        const Sower sower(*seeds.meadow, joined.species, joined.origin);
        const Sower alone(*own.seeds->view.meadow, own.species, own.origin);
        const SownCell all = sower.sow(cell, {});
        const SownCell meant = alone.sow(readSeedCell(own.seeds->view, 0, "own"), {});
        ASSERT_EQ(all.blades.size(), meant.blades.size());
        EXPECT_EQ(std::memcmp(all.blades.data(), meant.blades.data(),
                              all.blades.size() * sizeof all.blades[0]),
                  0);
    }
    EXPECT_EQ(joined.species[0].name, fields[1].species[0].name);
}

TEST(JoinedFields, RefuseSeedsThatCannotBeJoined)
{
    std::vector<Field> fields{tests::seeded(tests::sampleField()),
                              tests::seeded(tests::sampleField())};
    // Both have the same cell.
    EXPECT_NE(complaintOf(fields).find("field 1: has seeds of the cell"), std::string::npos);
    fields[1].origin.x += 1.0;
    EXPECT_NE(complaintOf(fields).find("no whole number"), std::string::npos);
    fields[1].origin.x += 31.0;
    EXPECT_EQ(complaintOf(fields), "");
    Seeds other = fields[1].seeds->seeds;
    other.meadow.density = 50.0;
    fields[1].seeds = std::make_shared<const SharedSeeds>(std::move(other));
    const std::string told = complaintOf(fields);
    EXPECT_NE(told.find("field 1"), std::string::npos);
    EXPECT_NE(told.find("density 40.0 and 50.0"), std::string::npos);
    EXPECT_NE(told.find("sward grow"), std::string::npos);
}

} // namespace
} // namespace sward::field
