// Tests which blades become resident if memory is limited.

#include "core/random.h"
#include "render/field/patch_tree.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "render/streaming/residency.h"
#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace sward::render {
namespace {

constexpr std::uint64_t residencySeed = 26;
constexpr glm::uvec2 residencySize(160, 100);

class ResidencyTest : public testing::Test {
protected:
    static const field::Field& cloud()
    {
        static const field::Field field = test::makeField({.surface = test::Surface::cloud,
                                                           .blades = 60'000,
                                                           .extent = 60.0f,
                                                           .seed = residencySeed});
        return field;
    }

    static shared::Eyepoint eyeAt(const Camera& camera)
    {
        const field::FieldView view = field::viewOf(cloud());
        FrameSettings settings;
        settings.lodThreshold = 1.0f;
        return frameOf({{}, view.bounds(), field::meanBladeSize(view)},
                       viewMatrices(camera, {}, residencySize, view.bounds()), settings, 0.0, 1)
            .view;
    }

    static Camera randomCamera(std::uint64_t index)
    {
        const auto at = [index](double reach, std::uint32_t dimension) {
            return reach * (2.0 * uniform(residencySeed, index, dimension) - 1.0);
        };
        Camera camera;
        camera.eye = {at(30.0, 0), at(30.0, 1), at(30.0, 2)};
        camera.target = {at(20.0, 3), at(20.0, 4), at(20.0, 5)};
        camera.fovY = 40.0f;
        return camera;
    }

    /// Loads everything that fits, in as many frames as it takes.
    static void settle(Residency& residency, const shared::Eyepoint& view, float threshold)
    {
        for (int frame = 0; frame < 1000; ++frame) {
            residency.look({&view, 1}, {}, threshold, 100);
            while (const auto wanted = residency.next()) {
                if (residency.freePlaces() == 0) {
                    const auto gone = residency.leave(*wanted);
                    if (!gone)
                        break;
                    residency.free(*gone);
                }
                residency.take(wanted->page);
                residency.arrive(wanted->page);
            }
            residency.finish();
            if (residency.isAllThere())
                return;
        }
        ADD_FAILURE() << "the pages do not come to rest";
    }

    static std::vector<std::uint32_t> placesOf(const Residency& residency)
    {
        std::vector<std::uint32_t> places;
        for (std::uint32_t page = 0; page < residency.tree().pageCount(); ++page)
            places.push_back(residency.placeOf(page));
        return places;
    }

    static bool isThere(const Residency& residency, const shared::Patch& cell)
    {
        const std::uint32_t last = cell.firstBlade + cell.bladeCount - 1;
        return residency.placeOf(cell.firstBlade / shared::pageBlades) != shared::noPlace &&
               residency.placeOf(last / shared::pageBlades) != shared::noPlace;
    }
};

TEST_F(ResidencyTest, BringsAllThatIsSeenWhereItFits)
{
    const field::FieldView field = field::viewOf(cloud());
    const std::vector<shared::Subtree> subtrees = subtreesOf(field.patches);
    Residency residency(field, 40);
    std::size_t seen = 0;
    std::size_t whole = 0;
    for (std::uint64_t c = 0; c < 40; ++c) {
        const shared::Eyepoint view = eyeAt(randomCamera(c));
        settle(residency, view, view.lodThreshold);
        if (residency.thinning() > 1.0f)
            continue;
        ++whole;
        for (std::size_t p = 0; p < field.patches.size(); ++p) {
            const shared::Patch& cell = field.patches[p];
            if (cell.bladeCount == 0 || shared::patchCulled(view, cell, subtrees[p].widest) ||
                shared::shareAt(view, shared::boxDistance(view.eye, cell.boundsLow,
                                                          cell.boundsHigh)) <= cell.rankLow)
                continue;
            ++seen;
            EXPECT_TRUE(isThere(residency, cell)) << "patch " << p << ", camera " << c;
        }
    }
    EXPECT_GT(whole, 5u);
    EXPECT_GT(seen, 100u);
}

TEST_F(ResidencyTest, HasWhatIsDrawnOfAThinnedField)
{
    // With too little memory for almost any camera.
    const field::FieldView field = field::viewOf(cloud());
    const std::vector<shared::Subtree> subtrees = subtreesOf(field.patches);
    Residency residency(field, 12);
    std::size_t thinned = 0;
    for (std::uint64_t c = 0; c < 40; ++c) {
        // Wider blades are visible from farther aside, which causes a new search.
        shared::Eyepoint view = eyeAt(randomCamera(c));
        const float threshold = view.lodThreshold;
        float thinning = 1.0f;
        bool isSettled = false;
        for (int i = 0; i < 12 && !isSettled; ++i) {
            view.lodThreshold = threshold * thinning;
            const std::vector<std::uint32_t> before = placesOf(residency);
            settle(residency, view, threshold);
            isSettled = residency.thinning() == thinning && placesOf(residency) == before;
            thinning = residency.thinning();
        }
        if (!isSettled || thinning <= 1.0f || thinning >= 8.0f)
            continue;
        ++thinned;
        for (std::size_t p = 0; p < field.patches.size(); ++p) {
            const shared::Patch& cell = field.patches[p];
            if (cell.bladeCount == 0 || shared::patchCulled(view, cell, subtrees[p].widest))
                continue;
            const float distance = shared::boxDistance(view.eye, cell.boundsLow, cell.boundsHigh);
            // A share above 1 is not representable here.
            const float share =
                view.lodWidth * view.pixelsPerUnit / std::max(distance, 1e-6f) / view.lodThreshold;
            if (share > cell.rankLow * 1.0001f) {
                EXPECT_TRUE(isThere(residency, cell)) << "patch " << p << ", camera " << c;
            }
        }
    }
    EXPECT_GT(thinned, 5u);
}

TEST_F(ResidencyTest, CountsThePatchesThatAreThereAsAWhole)
{
    const field::FieldView field = field::viewOf(cloud());
    Residency residency(field, 25);
    for (std::uint64_t c = 0; c < 30; ++c) {
        settle(residency, eyeAt(randomCamera(c)), 1.0f);
        std::uint64_t blades = 0;
        std::uint64_t patches = 0;
        std::set<std::uint32_t> places;
        for (const shared::Patch& cell : field.patches) {
            if (cell.bladeCount == 0 || !isThere(residency, cell))
                continue;
            blades += cell.bladeCount;
            ++patches;
            places.insert(residency.placeOf(cell.firstBlade / shared::pageBlades));
        }
        EXPECT_EQ(residency.tree().blades(), blades) << "camera " << c;
        EXPECT_GE(residency.tree().patches(), patches);
        EXPECT_LE(places.size(), 25u);
        for (const std::uint32_t place : places)
            EXPECT_LT(place, 25u * shared::pageBlades);
    }
}

} // namespace
} // namespace sward::render
