// Flights over fields of many times the blades that fit: what comes in each frame, and what that
// costs.

#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "render/streaming/eye_motion.h"
#include "render/streaming/page_budget.h"
#include "render/streaming/page_census.h"
#include "render/streaming/residency.h"
#include "support/fields/plain_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::render {
namespace {

constexpr std::uint32_t allowance = 256; ///< pages that a frame may bring: 4 MiB
constexpr std::uint32_t visits = 512;    ///< nodes of a frame
constexpr double framesPerSecond = 60.0;

/// 16.8 million blades on a square of 512 m.
const field::Field& plain()
{
    static const field::Field field =
        test::plainTree({.extent = 512.0f, .density = 64.0f, .width = 0.08f});
    return field;
}

/// Places for pages beside the tree: a blade takes 40 bytes in a host.
std::uint32_t placesWithin(const field::Field& field, std::uint64_t bytes)
{
    return static_cast<std::uint32_t>((bytes - treeBytes(field::viewOf(field))) /
                                      (shared::pageBlades * 40u));
}

/// An eye 3 m above the ground that looks in a direction [rad] from the x axis.
shared::Eyepoint lookingFrom(const field::Field& field, double x, double z, double direction)
{
    Camera camera;
    camera.eye = {x, 3.0, z};
    camera.target = {x + 40.0 * std::cos(direction), 0.5, z + 40.0 * std::sin(direction)};
    camera.fovY = 45.0f;
    const field::FieldView view = field::viewOf(field);
    Aabb content;
    content.add(view.patches[0].boundsLow);
    content.add(view.patches[0].boundsHigh);
    FrameSettings settings;
    settings.environment.drawDistance = 5000.0f;
    return frameOf({{}, content, {.height = 1.0f, .width = 0.08f}},
                   viewMatrices(camera, {}, {1920, 1080}, content), settings, 0.0, 1)
        .view;
}

/// Streams as a renderer does that records its copies.
class Flight {
public:
    Flight(const field::Field& field, std::uint32_t places, std::uint32_t most = allowance)
        : residency(field::viewOf(field), places)
        , most_(most)
    {
    }

    /// One frame; returns the pages that have come.
    std::vector<std::uint32_t> fly(shared::Eyepoint eye)
    {
        const float threshold = eye.lodThreshold;
        unthinned_.look({&eye, 1}, {}, threshold);
        eye.lodThreshold *= thinning_;
        const auto ahead = motion_.ahead({&eye, 1});
        residency.look({&eye, 1}, ahead, threshold, visits);
        std::vector<std::uint32_t> come;
        while (come.size() < most_) {
            const auto wanted = residency.next();
            if (!wanted)
                break;
            if (residency.freePlaces() == 0 && !makeRoom(*wanted))
                break;
            residency.take(wanted->page);
            residency.arrive(wanted->page);
            come.push_back(wanted->page);
        }
        residency.finish();
        if (thins)
            thinning_ = std::clamp(residency.thinning(), thinning_ / 1.1f, thinning_ * 1.1f);
        EXPECT_LE(residency.visited(), visits + come.size() * VisitBudget::perPage +
                                           VisitBudget::forRanking + 2 * maxAtOnce);
        return come;
    }

    void settle(const shared::Eyepoint& eye)
    {
        for (int frame = 0; frame < 2000; ++frame) {
            fly(eye);
            if (residency.isAllThere() && residency.thinning() == thinning_)
                return;
        }
        ADD_FAILURE() << "the pages do not come to rest";
    }

    /// Of all that the eye would draw if everything were there.
    float nearest() const { return nearestMissing(residency.tree(), unthinned_); }

    bool thins = true; ///< false: blades keep their widths, and the edges of the picture
    Residency residency;
    std::uint32_t evicted = 0;

private:
    /// Children of a node and patches of a page, by which a frame may exceed its visits.
    static constexpr std::uint32_t maxAtOnce = 16;

    bool makeRoom(const Residency::Wanted& wanted)
    {
        const auto gone = residency.leave(wanted);
        if (!gone)
            return false;
        // What is given up is worth less, to the eyes of this frame.
        const PageTree& tree = residency.tree();
        tree.forPatchesOf(gone->change.page, [&](std::uint32_t patch) {
            const auto sight =
                residency.scores().nearest(tree.patch(patch), tree.node(patch).widest, false);
            EXPECT_LT(PageScores::scoreOf(sight, tree.patch(patch).rankLow), wanted.score);
        });
        residency.free(*gone);
        ++evicted;
        return true;
    }

    std::uint32_t most_;
    EyeMotion motion_;
    PageScores unthinned_;
    float thinning_ = 1.0f;
};

TEST(ResidencyFlight, NeverLacksBladesWithin30MetresAt20MetresPerSecond)
{
    // A sixteenth of the usual allowance is enough.
    for (const std::uint32_t most : {allowance, allowance / 16}) {
        Flight flight(plain(), placesWithin(plain(), std::uint64_t(160) << 20), most);
        double x = -200.0;
        flight.settle(lookingFrom(plain(), x, 0.0, 0.0));
        std::size_t come = 0;
        for (int frame = 0; frame < 600; ++frame) {
            x += 20.0 / framesPerSecond;
            // It turns to both sides as it goes.
            const double direction = 0.7 * std::sin(frame / 90.0);
            come += flight.fly(lookingFrom(plain(), x, 0.0, direction)).size();
            ASSERT_GE(flight.nearest(), 30.0f) << "frame " << frame;
        }
        EXPECT_GT(come, 1000u);
        EXPECT_GT(flight.evicted, 1000u);
    }
}

TEST(ResidencyFlight, UsesTheWholeAllowanceWhilePagesAreMissing)
{
    // All that is seen fits; so each frame after a cut brings as much as it may until it is there.
    Flight flight(plain(), 12'000);
    flight.settle(lookingFrom(plain(), -150.0, 0.0, 0.0));
    const shared::Eyepoint cut = lookingFrom(plain(), 150.0, 20.0, 3.0);
    bool isAllThere = false;
    int frames = 0;
    for (; !isAllThere && frames < 200; ++frames) {
        const std::size_t come = flight.fly(cut).size();
        isAllThere = flight.nearest() == std::numeric_limits<float>::infinity();
        if (!isAllThere) {
            EXPECT_EQ(come, allowance) << "frame " << frames << " after the cut";
        }
    }
    EXPECT_TRUE(isAllThere);
    EXPECT_GT(frames, 5);
}

TEST(ResidencyFlight, BringsTheCoarsestAndNearestFirst)
{
    Flight flight(plain(), 12'000);
    flight.thins = false;
    const shared::Eyepoint eye = lookingFrom(plain(), 0.0, 0.0, 0.0);
    const PageTree& tree = flight.residency.tree();
    float before = std::numeric_limits<float>::infinity();
    for (int frame = 0; frame < 10; ++frame) {
        float best = 0.0f;
        float worst = before;
        for (const std::uint32_t page : flight.fly(eye)) {
            float score = 0.0f;
            tree.forPatchesOf(page, [&](std::uint32_t patch) {
                const auto sight = flight.residency.scores().nearest(
                    tree.patch(patch), tree.node(patch).widest, false);
                score = std::max(score, PageScores::scoreOf(sight, tree.patch(patch).rankLow));
            });
            best = std::max(best, score);
            worst = std::min(worst, score);
        }
        EXPECT_LE(best, before * Residency::margin) << "frame " << frame;
        before = worst;
    }
    // After these frames the ground around the eye is complete.
    EXPECT_GT(flight.nearest(), 30.0f);
}

TEST(ResidencyFlight, BringsWhatWillBeSeenBeforeItIsSeen)
{
    // Looking along z, moving along x: what comes into sight does so at one side.
    Flight flight(plain(), placesWithin(plain(), std::uint64_t(160) << 20), 16);
    const double direction = 1.5708;
    double x = -100.0;
    flight.settle(lookingFrom(plain(), x, -100.0, direction));
    std::size_t ahead = 0;
    std::size_t behind = 0;
    for (int frame = 0; frame < 30; ++frame) {
        x += 20.0 / framesPerSecond;
        const shared::Eyepoint eye = lookingFrom(plain(), x, -100.0, direction);
        PageScores now;
        now.look({&eye, 1}, {}, eye.lodThreshold);
        for (const std::uint32_t page : flight.fly(eye)) {
            bool isSeen = false;
            float middle = 0.0f;
            flight.residency.tree().forPatchesOf(page, [&](std::uint32_t patch) {
                const shared::Patch& cell = flight.residency.tree().patch(patch);
                isSeen =
                    isSeen ||
                    !now.nearest(cell, flight.residency.tree().node(patch).widest, false).isOutside;
                middle = 0.5f * (cell.boundsLow.x + cell.boundsHigh.x);
            });
            if (!isSeen)
                (middle > eye.eye.x ? ahead : behind) += 1;
        }
    }
    EXPECT_GT(ahead, 50u) << "pages come before they are in sight";
    EXPECT_GT(ahead, 20 * behind) << "on the side to which the eye moves";
}

TEST(ResidencyFlight, VisitsNoMoreNodesInLargerFields)
{
    // The bound of each frame is checked by fly(); here the work of flights is compared.
    std::vector<double> visited;
    for (const float extent : {512.0f, 1024.0f}) {
        const field::Field field = test::plainTree({.extent = extent, .density = 64.0f});
        Flight flight(field, 4000);
        double x = -0.4 * double(extent);
        flight.settle(lookingFrom(field, x, 0.0, 0.0));
        double sum = 0.0;
        for (int frame = 0; frame < 120; ++frame) {
            x += 20.0 / framesPerSecond;
            flight.fly(lookingFrom(field, x, 0.0, 0.0));
            sum += flight.residency.visited();
        }
        visited.push_back(sum / 120.0);
    }
    EXPECT_LT(visited[1], 2.0 * visited[0]);
    EXPECT_LT(visited[0], double(visits + allowance));
}

TEST(ResidencyFlight, SurvivesCuts)
{
    Flight flight(plain(), placesWithin(plain(), std::uint64_t(160) << 20));
    flight.settle(lookingFrom(plain(), -200.0, 0.0, 0.0));
    for (int cut = 0; cut < 20; ++cut) {
        const double angle = 2.4 * cut;
        for (int frame = 0; frame < 4; ++frame)
            flight.fly(lookingFrom(plain(), 180.0 * std::cos(angle), 180.0 * std::sin(angle),
                                   1.7 * angle));
        EXPECT_GT(flight.nearest(), 30.0f) << "four frames after a cut";
    }
}

} // namespace
} // namespace sward::render
