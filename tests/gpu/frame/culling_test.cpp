// Tests culling on the device against the predicates on the CPU, and against the visible picture.

#include "core/random.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "update_bench.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace sward::render {
namespace {

constexpr std::uint64_t cullingSeed = 41;
constexpr glm::uvec2 cullingSize(320, 180);

/// Cameras in and around a cube of 10 m.
Camera cullingCamera(std::uint64_t index)
{
    const auto at = [index](double reach, std::uint32_t dimension) {
        return reach * (2.0 * uniform(cullingSeed, index, dimension) - 1.0);
    };
    Camera camera;
    camera.eye = {at(9.0, 0), at(9.0, 1), at(9.0, 2)};
    camera.target = {at(5.0, 3), at(5.0, 4), at(5.0, 5)};
    camera.up = glm::vec3(glm::dvec3(at(1.0, 6), 1.0, at(1.0, 7)));
    camera.fovY = static_cast<float>(30.0 + 60.0 * uniform(cullingSeed, index, 8));
    // Every second camera ends inside the field, so that near and far planes also cut blades.
    if (index % 2 == 1) {
        camera.near = 1.5f;
        camera.far = 7.0f;
    }
    return camera;
}

class CullingTest : public test::GpuTest {
protected:
    CullingTest()
        : bench_(context(), field::viewOf(field_))
        , patches_(field::patchOfBlades(field::viewOf(field_)))
        , states_(field_.blades.size())
    {
        // Bend the blades in every direction, as after a storm.
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const auto part = [i](std::uint32_t d) {
                return static_cast<float>(1.4 * uniform(cullingSeed, i, 50 + d) - 0.7);
            };
            states_[i].turn = shared::packSnorm16(part(0)) | shared::packSnorm16(part(1)) << 16;
        }
    }

    shared::Frame frame(const Camera& camera, std::uint32_t mask) const
    {
        const Aabb content = field::viewOf(field_).bounds();
        FrameSettings settings;
        settings.cullMask = mask;
        settings.leavesThinned = false; // every blade has a cull result
        settings.lodThreshold = 2.0f;
        settings.environment.drawDistance = 8.0f;
        settings.updateRate.everyFrame = 1e6f; // at any distance
        return frameOf({{}, content, bench_.bladeSize()},
                       viewMatrices(camera, {}, cullingSize, content), settings, 1.0, 1);
    }

    test::UpdateBench::Result run(const shared::Frame& frame)
    {
        return bench_.run(frame, FrameSettings(), states_, 0.0f, UpdateCullPass::Scope::visible);
    }

    shared::Blade blade(std::size_t i) const
    {
        return shared::unpackBlade(field_.blades[i], field_.patches[patches_[i]]);
    }

    field::Field field_ =
        test::makeField({.surface = test::Surface::cloud, .blades = 4200, .seed = cullingSeed});
    test::UpdateBench bench_;
    std::vector<std::uint32_t> patches_;
    std::vector<shared::BladeState> states_;
};

/// Whether rounding may change the result: a blade within `margin` of a threshold (relative, or
/// metres for a plane). The device uses the same formulas in the same precision; 1e-5 is about
/// fifty times its rounding over ten metres.
bool isClose(const shared::Frame& frame, const shared::Blade& blade, shared::BladeState state,
             const shared::Verdict& verdict)
{
    constexpr float margin = 1e-5f;
    const shared::PosedBlade posed = shared::posedBlade(blade, state);
    const glm::vec3 ray = blade.root - frame.view.eye;
    const float distance = glm::length(ray);
    shared::Eyepoint narrower = frame.view;
    shared::Eyepoint wider = narrower;
    narrower.minWidth *= 1.0f - 10.0f * margin;
    wider.minWidth *= 1.0f + 10.0f * margin;
    const float factor = verdict.widthFactor > 0.0f ? verdict.widthFactor : 1.0f;
    if (shared::seenTooNarrow(narrower, posed, factor) !=
        shared::seenTooNarrow(wider, posed, factor))
        return true;
    if (std::abs(distance - frame.view.drawDistance) < margin * distance)
        return true;
    for (const glm::vec4& plane : frame.view.planes) {
        const float reach = std::max({shared::planeDistance(plane, posed.v0),
                                      shared::planeDistance(plane, posed.v1),
                                      shared::planeDistance(plane, posed.v2)});
        const float reserve =
            0.5f * shared::outlineMost * blade.width * std::max(verdict.widthFactor, 1.0f) +
            shared::sectionMargin(distance + blade.height, frame.view.minWidth);
        if (std::abs(reach + reserve) < margin)
            return true;
    }
    // The last blade of the share has almost no width.
    return verdict.cullResult == shared::cullResultDrawn && verdict.widthFactor < 1e-3f;
}

TEST_F(CullingTest, CullsAsTheCpuDoesSaveWhereRoundingDecides)
{
    const std::vector<shared::Subtree> subtrees = subtreesOf(field_.patches);
    std::size_t close = 0;
    std::size_t tested = 0;
    std::array<std::size_t, shared::cullResultCount> seen{};
    for (std::uint64_t c = 0; c < 12; ++c) {
        const shared::Frame frame = this->frame(cullingCamera(c), c % 3 == 2 ? 14u : 15u);
        const auto result = run(frame);
        const shared::Eyepoint view = frame.view;

        for (std::size_t p = 0; p < field_.patches.size(); ++p) {
            const shared::Patch& cell = field_.patches[p];
            const bool culled = shared::patchCulled(view, cell, subtrees[p].widest);
            const shared::LeafAreaLimit limit = shared::leafAreaLimitOf(view, cell);
            for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                const std::size_t index = cell.firstBlade + i;
                const shared::Blade drawn = shared::raised(blade(index), limit.height);
                const shared::Verdict verdict =
                    shared::cullBlade(view, limit, shared::posedBlade(drawn, states_[index]),
                                      shared::bladeRank(cell, i));
                const std::uint32_t expected =
                    culled ? shared::cullResultPatch : verdict.cullResult;
                ++tested;
                ++seen[result.cullResults[index]];
                if (result.cullResults[index] == expected)
                    continue;
                ASSERT_TRUE(isClose(frame, drawn, states_[index], verdict))
                    << "blade " << index << " has cull result " << result.cullResults[index]
                    << ", expected " << expected << "; camera " << c << ", seed " << cullingSeed;
                ++close;
            }
        }
    }
    EXPECT_LE(close, tested / 5000);
    for (const std::uint32_t cullResult :
         {shared::cullResultDrawn, shared::cullResultPatch, shared::cullResultOrientation,
          shared::cullResultFrustum, shared::cullResultDistance, shared::cullResultLod})
        EXPECT_GT(seen[cullResult], 0u)
            << "no camera of this test gives cull result " << cullResult;
}

TEST_F(CullingTest, CullsTheSameWhoeverTakesAPatch)
{
    ASSERT_GT(field_.patches.size(), 2 * shared::patchesTogether);
    for (const std::uint32_t groups : {1u, 2u, 5u}) {
        test::UpdateBench together(context(), field::viewOf(field_), {.groups = groups});
        for (std::uint64_t c = 0; c < 4; ++c) {
            const shared::Frame frame = this->frame(cullingCamera(c), c == 0 ? 0u : 15u);
            const auto expected = run(frame);
            const auto result =
                together.run(frame, FrameSettings(), states_, 0.0f, UpdateCullPass::Scope::visible);
            EXPECT_EQ(result.cullResults, expected.cullResults)
                << groups << " groups, camera " << c;
            std::set<std::uint32_t> listed;
            for (const shared::VisibleBlade& visible : result.visible) {
                ASSERT_TRUE(listed.insert(visible.blade).second) << "blade " << visible.blade;
                ASSERT_EQ(result.cullResults[visible.blade], shared::cullResultDrawn);
                ASSERT_EQ(visible.patchIndex, patches_[visible.blade]);
            }
            EXPECT_EQ(listed.size(), expected.visible.size()) << groups << " groups, camera " << c;
            EXPECT_EQ(result.draw.simulated, expected.draw.simulated);
            EXPECT_EQ(result.draw.instanceCount, expected.draw.instanceCount);
        }
    }
}

TEST_F(CullingTest, CullsTheSameByAShaderThatKnowsWhatIsAsked)
{
    for (const bool recordsCullResults : {true, false}) {
        const auto benchOf = [&](bool hasAllFeatures) {
            return test::UpdateBench(
                context(), field::viewOf(field_),
                {.recordCullResults = recordsCullResults, .hasAllFeatures = hasAllFeatures});
        };
        test::UpdateBench ready = benchOf(true);
        test::UpdateBench knowing = benchOf(false);
        for (std::uint32_t i = 0; i < 6; ++i) {
            // Each test alone, none, and all; with and without level of detail and layers.
            shared::Frame frame =
                this->frame(cullingCamera(i), std::array{1u, 2u, 4u, 8u, 0u, 15u}[i]);
            frame.view.lodThreshold *= i % 2 == 0 ? 0.0f : 1.0f;
            frame.view.maxLeafArea = i % 3 == 0 ? 0.0f : 1e-3f;
            const auto run = [&](test::UpdateBench& bench) {
                return bench.run(frame, FrameSettings(), states_, 0.03f,
                                 UpdateCullPass::Scope::visible);
            };
            const auto expected = run(ready);
            const auto result = run(knowing);
            EXPECT_EQ(result.cullResults, expected.cullResults) << "frame " << i;
            EXPECT_TRUE(std::ranges::equal(result.draw.cullResults, expected.draw.cullResults));
            EXPECT_EQ(result.draw.simulated, expected.draw.simulated);
            const auto listed = [](const test::UpdateBench::Result& of) {
                std::map<std::uint32_t, std::uint32_t> factors;
                for (const shared::VisibleBlade& visible : of.visible)
                    factors[visible.blade] = visible.factors;
                return factors;
            };
            EXPECT_EQ(listed(result), listed(expected)) << "frame " << i;
        }
    }
}

TEST_F(CullingTest, ListsExactlyTheDrawnBladesEachOnce)
{
    for (std::uint64_t c = 0; c < 6; ++c) {
        const auto result = run(frame(cullingCamera(c), c == 0 ? 0u : 15u));
        std::set<std::uint32_t> listed;
        for (const shared::VisibleBlade& visible : result.visible) {
            ASSERT_TRUE(listed.insert(visible.blade).second) << "blade " << visible.blade;
            ASSERT_EQ(result.cullResults[visible.blade], shared::cullResultDrawn);
            ASSERT_EQ(visible.patchIndex, patches_[visible.blade]);
            ASSERT_GT(shared::widthFactorOf(visible), 0.0f);
        }
        EXPECT_EQ(listed.size(), result.draw.cullResults[shared::cullResultDrawn])
            << "camera " << c;
        // Exactly the required number of chunks.
        EXPECT_EQ(result.draw.vertexCount, shared::drawChunk);
        EXPECT_EQ(result.draw.instanceCount,
                  (listed.size() + shared::drawChunk - 1) / shared::drawChunk);
    }
}

TEST_F(CullingTest, CountsAddUpToAllBladesForEveryMask)
{
    for (std::uint32_t mask = 0; mask < 16; ++mask) {
        const auto result = run(frame(cullingCamera(mask), mask));
        const std::uint64_t sum =
            std::accumulate(std::begin(result.draw.cullResults), std::end(result.draw.cullResults),
                            std::uint64_t(0));
        EXPECT_EQ(sum, field_.blades.size()) << "mask " << mask;
        EXPECT_EQ(result.draw.simulated + result.draw.cullResults[shared::cullResultPatch],
                  field_.blades.size());
        // A disabled test culls no blade.
        const std::array tests = {std::pair(shared::cullPatch, shared::cullResultPatch),
                                  std::pair(shared::cullOrientation, shared::cullResultOrientation),
                                  std::pair(shared::cullFrustum, shared::cullResultFrustum),
                                  std::pair(shared::cullDistance, shared::cullResultDistance)};
        for (const auto& [bit, cullResult] : tests)
            EXPECT_TRUE((mask & bit) != 0 || result.draw.cullResults[cullResult] == 0)
                << "mask " << mask << ", cull result " << cullResult;
        std::array<std::uint32_t, shared::cullResultCount> cullResults{};
        for (const std::uint32_t cullResult : result.cullResults)
            ++cullResults[cullResult];
        for (std::uint32_t cullResult = 0; cullResult < shared::cullResultCount; ++cullResult)
            EXPECT_EQ(cullResults[cullResult], result.draw.cullResults[cullResult])
                << "mask " << mask;
    }
}

TEST_F(CullingTest, DropsNoBladeOfWhichAPointIsInThePicture)
{
    for (std::uint64_t c = 0; c < 12; ++c) {
        const shared::Frame frame =
            this->frame(cullingCamera(c), shared::cullPatch | shared::cullFrustum);
        const auto result = run(frame);
        for (std::size_t i = 0; i < field_.blades.size(); ++i) {
            if (result.cullResults[i] != shared::cullResultPatch &&
                result.cullResults[i] != shared::cullResultFrustum)
                continue;
            const shared::Blade blade = this->blade(i);
            const glm::vec3 axis = shared::widthAxis(blade.up, blade.facing);
            const shared::Pose pose =
                shared::poseOfState(shared::axesAlong(blade.up, axis), states_[i]);
            for (int step = 0; step <= 20; ++step) {
                for (const float side : {-0.5f, 0.0f, 0.5f}) {
                    const glm::vec3 point =
                        blade.root + side * blade.width * axis +
                        blade.height * shared::bezierPoint(glm::vec3(0.0f), pose.v1, pose.v2,
                                                           0.05f * static_cast<float>(step));
                    const glm::vec4 clip = frame.viewProjection * glm::vec4(point, 1.0f);
                    const float w = clip.w * (1.0f - 1e-4f);
                    ASSERT_FALSE(std::abs(clip.x) < w && std::abs(clip.y) < w && clip.z > 0.0f &&
                                 clip.z < w)
                        << "blade " << i << " is seen, but has cull result "
                        << result.cullResults[i] << "; camera " << c << ", seed " << cullingSeed;
                }
            }
        }
    }
}

} // namespace
} // namespace sward::render
