// The physics on the device against the same functions on the CPU.

#include "core/random.h"
#include "render/frame.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "update_bench.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sward::render {
namespace {

constexpr std::uint64_t seed = 20170226;

using PhysicsTest = test::GpuTest;

float between(float low, float high, std::uint64_t index, std::uint32_t dimension)
{
    return low + (high - low) * static_cast<float>(uniform(seed, index, dimension));
}

glm::vec3 direction(std::uint64_t index, std::uint32_t dimension)
{
    const float z = between(-1.0f, 1.0f, index, dimension);
    const float angle = between(0.0f, shared::twoPi, index, dimension + 1);
    const float side = std::sqrt(1.0f - z * z);
    return {side * std::cos(angle), side * std::sin(angle), z};
}

/// Tips anywhere around the root, as collisions and broken time leave them; every second blade was
/// hit.
std::vector<shared::BladeState> randomStates(std::size_t count)
{
    std::vector<shared::BladeState> states(count);
    for (std::size_t i = 0; i < count; ++i)
        states[i] = shared::packState(between(0.0f, 2.0f, i, 100) * direction(i, 101),
                                      i % 2 == 0 ? 0.0f : between(0.0f, 1.0f, i, 103));
    return states;
}

shared::Frame randomNature(std::uint64_t run)
{
    FrameSettings settings;
    settings.nature.wind = {
        direction(run, 0),           between(0.0f, 8.0f, run, 2),  between(2.0f, 20.0f, run, 3),
        between(0.5f, 8.0f, run, 4), between(1.0f, 10.0f, run, 5), between(0.0f, 1.0f, run, 6)};
    settings.nature.gravityDirection = direction(run, 7);
    settings.nature.gravityStrength = between(0.0f, 5.0f, run, 9);
    settings.nature.attractor = glm::dvec3(20.0f * direction(run, 10));
    settings.nature.attractorBlend = between(0.0f, 1.0f, run, 12);
    settings.nature.recovery = between(1.0f, 12.0f, run, 13);
    return frameOf({}, ViewMatrices{}, settings, static_cast<double>(between(6.0f, 60.0f, run, 14)),
                   1);
}

int quanta(std::uint32_t a, std::uint32_t b)
{
    const auto signedOf = [](std::uint32_t bits) {
        return static_cast<std::int16_t>(bits & 0xffffu);
    };
    return std::abs(signedOf(a) - signedOf(b));
}

/// Largest difference of the stored displacement, in steps of its 16-bit numbers.
int difference(const shared::BladeState& a, const shared::BladeState& b)
{
    return std::max({quanta(a.xy, b.xy), quanta(a.xy >> 16, b.xy >> 16), quanta(a.zEta, b.zEta)});
}

TEST_F(PhysicsTest, MovesRandomBladesAsTheCpuDoes)
{
    const field::Field field =
        test::makeField({.surface = test::Surface::cloud, .blades = 4096, .seed = seed});
    const field::FieldView view = field::viewOf(field);
    const std::vector<std::uint32_t> patches = field::patchOfBlades(view);
    const std::vector<shared::BladeState> before = randomStates(field.blades.size());
    test::UpdateBench bench(context(), view);

    std::size_t compared = 0;
    std::size_t beyondOne = 0;
    for (std::uint64_t run = 0; run < 12; ++run) {
        // From a tenth of a millisecond to five seconds.
        const float elapsed = 1e-4f * std::pow(5e4f, static_cast<float>(run) / 11.0f);
        const shared::Frame frame = randomNature(run);
        const auto result = bench.run(frame, before, elapsed, UpdateCullPass::Scope::all);

        // The device takes the time since the patch was last moved from two stored floats.
        const float stored = frame.time - (frame.time - elapsed);
        for (std::size_t i = 0; i < field.blades.size(); ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[i], field.patches[patches[i]]);
            const shared::BladeState expected = shared::advanceBlade(
                blade, frame.gravity, frame.wind, frame.recovery, before[i], frame.time, stored);
            const int steps = difference(result.states[i], expected);
            // Both round the same formulas; one step is what rounding alone explains (and all that
            // lavapipe shows), a tip close above its root may amplify it a little.
            ASSERT_LE(steps, 4) << "blade " << i << ", run " << run << ", " << elapsed
                                << " s, seed " << seed;
            ASSERT_LE(quanta(result.states[i].zEta >> 16, expected.zEta >> 16), 1)
                << "blade " << i << ", run " << run;
            beyondOne += steps > 1 ? 1 : 0;
            ++compared;
        }
    }
    RecordProperty("compared", static_cast<int>(compared));
    RecordProperty("beyond_one_step", static_cast<int>(beyondOne));
    EXPECT_LE(beyondOne, compared / 1000) << compared << " compared, seed " << seed;
}

TEST_F(PhysicsTest, LeavesAFieldAtAStandstillUntouched)
{
    const field::Field field =
        test::makeField({.surface = test::Surface::cloud, .blades = 1000, .seed = seed});
    const std::vector<shared::BladeState> before = randomStates(field.blades.size());
    test::UpdateBench bench(context(), field::viewOf(field));
    const auto result = bench.run(randomNature(1), before, 0.0f, UpdateCullPass::Scope::all);
    for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_EQ(result.states[i].xy, before[i].xy) << "blade " << i;
        ASSERT_EQ(result.states[i].zEta, before[i].zEta) << "blade " << i;
    }
}

} // namespace
} // namespace sward::render
