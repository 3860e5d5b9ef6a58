// A device grows the units of a field's seeds byte for byte as the CPU does.
#include "bake/bake.h"
#include "bake/settings/meadow.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "field/seeds/sow_unit.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"
#include "render/field/free_ranges.h"
#include "render/frame/shader_names.h"
#include "render/sowing/device_sower.h"
#include "render/sowing/unit_order.h"
#include "support/gpu/gpu_fixture.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

field::Field seededField(const terrain::GroundMesh& ground, double density, double vertical)
{
    bake::BakeSettings settings;
    settings.meadow = bake::loadMeadow("meadow");
    settings.density = density;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.align.vertical = vertical;
    settings.seeds = bake::SeedUse::always;
    Diagnostics diagnostics;
    Progress progress;
    return bake::bakeField(ground, settings, 1, diagnostics, progress).field;
}

bool isInside(const glm::vec3& low, const glm::vec3& high, const shared::Patch& box)
{
    return low.x >= box.boundsLow.x && low.y >= box.boundsLow.y && low.z >= box.boundsLow.z &&
           high.x <= box.boundsHigh.x && high.y <= box.boundsHigh.y && high.z <= box.boundsHigh.z;
}

/// The blades of units of a field, grown by the device and put behind one another.
class DeviceSowerTest : public test::GpuTest {
protected:
    struct Found {
        std::size_t units = 0;
        std::size_t refused = 0;
        std::size_t blades = 0;
        std::size_t ribbons = 0;
        std::size_t split = 0; ///< octree cells with several patches
    };

    /// Grows every `stride`th unit of the field's cells and compares it with the CPU's.
    Found grow(const field::Field& field, std::size_t stride)
    {
        const field::SeedsView& seeds = field.seeds->view;
        const std::vector<field::Species> species(field.species.begin(), field.species.end());
        const field::Sower sower(*seeds.meadow, species, field.origin);
        const gpu::ShaderLibrary shaders(embedded::shaders());
        DeviceSower device(context(), shaders, sower,
                           {.framesInFlight = 1,
                            .maxCandidates = 1U << 16U,
                            .cellBytes = VkDeviceSize(24) << 20U,
                            .stagingBytes = VkDeviceSize(8) << 20U});
        std::vector<UnitOrder> orders;
        for (std::size_t index = 0; index < seeds.cells.size(); ++index) {
            const auto cell = std::make_shared<const field::UnitCell>(
                field::readSeedCell(seeds, index, "seeds"), sower);
            for (const field::SowUnit& unit : field::unitsOf(*cell, seeds.meadow->levels))
                orders.push_back(orderOf(sower, index, cell, unit));
        }
        Found found;
        std::map<field::SowUnit, const UnitOrder*> known;
        std::size_t next = 0;
        bool isBusy = true;
        while (isBusy) {
            const DeviceSower::Finished finished = device.finish(0);
            device.begin(0);
            std::uint32_t places = 0;
            for (const DeviceSower::Grown& one : finished.grown) {
                device.place(one, places);
                places += one.unit.bladeCount;
            }
            for (; next < orders.size(); next += stride) {
                const DeviceSower::Added added = device.add(orders[next]);
                EXPECT_NE(added, DeviceSower::Added::never);
                if (added != DeviceSower::Added::yes)
                    break;
                known[orders[next].unit] = &orders[next];
            }
            const gpu::Buffer table(context(),
                                    {.name = "table",
                                     .bytes = (places + 1) * sizeof(shared::PackedBlade),
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
            gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
                device.record({context(), commands}, table);
            });
            const auto blades = gpu::readBufferAs<shared::PackedBlade>(context(), table);
            places = 0;
            for (const DeviceSower::Grown& one : finished.grown) {
                compare(one.unit, std::span(blades).subspan(places, one.unit.bladeCount), sower,
                        species, *known.at(one.unit.unit)->cell, found);
                places += one.unit.bladeCount;
            }
            found.refused += finished.refused.size();
            isBusy = next < orders.size() || device.isBusy();
        }
        return found;
    }

    static void compare(const field::UnitPatches& unit, std::span<const shared::PackedBlade> blades,
                        const field::Sower& sower, std::span<const field::Species> species,
                        const field::UnitCell& cell, Found& found)
    {
        const field::GrownUnit expected = field::growUnit(sower, species, cell, unit.unit);
        ++found.units;
        found.blades += blades.size();
        ASSERT_EQ(unit.patches.size(), expected.patches.size());
        ASSERT_EQ(unit.bladeCount, expected.blades.size());
        ASSERT_EQ(std::memcmp(blades.data(), expected.blades.data(), blades.size_bytes()), 0);
        ASSERT_GE(unit.widest, expected.widest);
        for (std::size_t i = 0; i < unit.patches.size(); ++i) {
            const shared::Patch& a = unit.patches[i];
            const shared::Patch& b = expected.patches[i];
            ASSERT_EQ(a.firstBlade, b.firstBlade);
            ASSERT_EQ(a.bladeCount, b.bladeCount);
            ASSERT_EQ(a.rootLow, b.rootLow);
            ASSERT_EQ(a.rootStep, b.rootStep);
            ASSERT_EQ(a.rankLow, b.rankLow);
            ASSERT_EQ(a.rankHigh, b.rankHigh);
            ASSERT_TRUE(isInside(b.boundsLow, b.boundsHigh, a));
            ASSERT_TRUE(isInside(a.boundsLow + 0.01f, a.boundsHigh - 0.01f, b)) << "hardly larger";
            ASSERT_NEAR(a.coneCosine, b.coneCosine, 1e-3f);
            if (i > 0)
                found.split += a.rootLow == unit.patches[i - 1].rootLow ? 1U : 0U;
            for (std::uint32_t k = 0; k < a.bladeCount; ++k) {
                const shared::Blade blade = shared::unpackBlade(blades[a.firstBlade + k], a);
                found.ribbons += species[blade.species].organs.empty() ? 0U : 1U;
                ASSERT_GE(glm::dot(a.coneAxis, blade.up), a.coneCosine);
            }
        }
    }
};

TEST_F(DeviceSowerTest, GrowsTheBytesOfTheCpu)
{
    struct Ground {
        std::string name;
        terrain::GroundMesh mesh;
        double density;
        double vertical;
        std::size_t stride;
    };
    const Ground grounds[] = {{"hills", meshes::hills(60.0, 30), 150.0, 0.0, 7},
                              {"sphere", meshes::sphere(24, 9.0), 300.0, 0.0, 5},
                              {"steep hills", meshes::hills(30.0, 60), 900.0, 0.4, 11},
                              {"book", meshes::book(), 4000.0, 0.0, 1},
                              {"moebius", meshes::moebius(), 3000.0, 0.0, 1}};
    Found all;
    for (const Ground& ground : grounds) {
        const Found found =
            grow(seededField(ground.mesh, ground.density, ground.vertical), ground.stride);
        EXPECT_EQ(found.refused, 0U) << ground.name;
        EXPECT_GT(found.blades, 1000U) << ground.name;
        EXPECT_FALSE(HasFatalFailure()) << ground.name;
        all.units += found.units;
        all.ribbons += found.ribbons;
        all.split += found.split;
        if (HasFatalFailure())
            return;
    }
    EXPECT_GT(all.units, 60U);
    EXPECT_GT(all.ribbons, 1000U);
    EXPECT_GT(all.split, 5U);
}

} // namespace
} // namespace sward::render
