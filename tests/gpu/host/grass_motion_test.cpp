// Motion vectors: previous position of a blade's point minus its current position.

#include "host_picture.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

using test::HostPicture;
using test::hostSize;
using test::lookingFrom;

class GrassMotionTest : public test::GrassTest {
protected:
    GrassMotionTest()
    {
        settings_.winds.clear();
        settings_.updateRate.everyFrame = 1e6f;
    }

    void drawAt(Grass& grass, double time, const HostView& view) const
    {
        const HostPicture* const pictures[]{&picture_};
        drawFrame(grass, time, {&view, 1}, pictures);
    }

    /// The largest motion, in widths and heights of the picture.
    float largest() const
    {
        float most = 0.0f;
        for (const glm::vec2 motion : picture_.motion())
            most = std::max(most, glm::length(motion));
        return most;
    }

    /// Share of the grass's pixels whose motion is that of a point with previous clip position
    /// `before` · place.
    double shareThatCameFrom(const HostView& view, const glm::dmat4& before) const
    {
        const std::vector<float> depths = picture_.depths();
        const std::vector<glm::vec2> motion = picture_.motion();
        const glm::dmat4 toWorld = glm::inverse(view.worldToClip);
        std::size_t right = 0;
        std::size_t all = 0;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            if (depths[i] == 0.0f)
                continue;
            const glm::dvec2 pixel(double(i % hostSize.x) + 0.5, double(i / hostSize.x) + 0.5);
            const glm::dvec2 place = 2.0 * pixel / glm::dvec2(hostSize) - 1.0;
            glm::dvec4 world = toWorld * glm::dvec4(place, double(depths[i]), 1.0);
            world /= world.w;
            const glm::dvec4 then = before * world;
            const glm::dvec2 expected = 0.5 * (glm::dvec2(then) / then.w - place);
            ++all;
            // A tenth of a pixel.
            const double error = glm::length(expected - glm::dvec2(motion[i]));
            right += error < 0.1 / double(hostSize.x) ? 1u : 0u;
        }
        EXPECT_GT(all, 500u);
        return double(right) / double(all);
    }

    const HostPicture picture_{context(), {.hasMotion = true}};
    const Grass::Settings kept_{.framesInFlight = 1, .keepsMotion = true};
};

TEST_F(GrassMotionTest, IsThatOfTheCameraWhereNothingElseMoves)
{
    Grass grass(context(), kept_);
    grass.add({upload(field_), {}});
    HostView view = lookingFrom({1.0, 2.0, 4.0});
    for (const double time : {0.0, 30.0, 60.0})
        drawAt(grass, time, view);
    EXPECT_LT(largest(), 1e-4f);
    const HostView before = view;
    view = lookingFrom({1.2, 2.1, 3.9});
    view.clipBefore = before.worldToClip;
    drawAt(grass, 60.02, view);
    EXPECT_GT(largest(), 0.01f);
    EXPECT_GT(shareThatCameFrom(view, before.worldToClip), 0.98);
}

TEST_F(GrassMotionTest, IsThatOfAnInstanceThatMoves)
{
    Grass grass(context(), kept_);
    const InstanceId id = grass.add({upload(field_), {}});
    const HostView view = lookingFrom({1.0, 2.0, 4.0});
    for (const double time : {0.0, 30.0, 60.0})
        drawAt(grass, time, view);
    const Placement moved{.position = {0.1, 0.0, 0.05},
                          .rotation = glm::angleAxis(0.05, glm::dvec3(0.0, 1.0, 0.0)),
                          .scale = 1.01};
    grass.move(id, moved);
    drawAt(grass, 60.02, view);
    const glm::dmat4 before = view.worldToClip * glm::inverse(moved.toWorld({}));
    EXPECT_GT(shareThatCameFrom(view, before), 0.95);
    // The next frame has no motion.
    drawAt(grass, 60.04, view);
    EXPECT_LT(largest(), 1e-3f);
}

TEST_F(GrassMotionTest, IsThatOfBladesInTheWindAndNoneAtAStandstill)
{
    Grass grass(context(), kept_);
    grass.add({upload(field_), {}});
    settings_.winds = {windSource(shared::windGusts)};
    settings_.winds[0].source.strength = 8.0f;
    const HostView view = lookingFrom({1.0, 2.0, 4.0});
    drawAt(grass, 0.0, view);
    EXPECT_EQ(largest(), 0.0f);
    // Until a wind front has passed.
    drawAt(grass, 0.5, view);
    float moved = 0.0f;
    for (int frame = 6; frame < 60; ++frame) {
        drawAt(grass, 0.1 * frame, view);
        moved = std::max(moved, largest());
    }
    EXPECT_GT(moved, 1e-3f);
    EXPECT_LT(moved, 0.2f);
    drawAt(grass, 0.1 * 59, view);
    EXPECT_EQ(largest(), 0.0f);
}

} // namespace
} // namespace sward::render
