// Clocks of hosts: of any origin, and some that are set back.

#include "host_picture.h"

#include <gtest/gtest.h>

#include <vector>

namespace sward::render {
namespace {

using test::hostSize;
using test::lookingFrom;
using test::pixelsApart;

/// Seconds since 1970, and a multiple of the wave's period.
constexpr double years = 1.8e9;

class GrassTimeTest : public test::GrassTest {
protected:
    GrassTimeTest()
    {
        // Its pattern repeats after twenty waves, of 4 s each.
        WindSource wave = windSource(windWave);
        wave.source.strength = 8.0f;
        wave.source.size = 8.0f;
        wave.source.speed = 2.0f;
        settings_.winds = {wave};
        settings_.updateRate.everyFrame = 1e6f;
    }

    std::vector<std::byte> at(Grass& grass, double time) const
    {
        return drawnAlone(grass, time, view_);
    }

    /// Pixels that differ visibly from those of grass whose first frame is at `time`.
    std::size_t apartFromNew(const std::vector<std::byte>& picture, double time) const
    {
        Grass grass(context(), oneSlot_);
        grass.add({resident_, {}});
        return pixelsApart(picture, at(grass, time), 24);
    }

    const HostView view_ = lookingFrom({1.0, 2.0, 4.0});
    const std::shared_ptr<ResidentField> resident_ = upload(field_);
};

TEST_F(GrassTimeTest, AClockThatCountsFrom1970GivesThePicturesOfAnEarlyOne)
{
    Grass early(context(), oneSlot_);
    Grass late(context(), oneSlot_);
    early.add({resident_, {}});
    late.add({resident_, {}});
    std::vector<std::byte> before;
    for (int frame = 0; frame < 24; ++frame) {
        const double time = 100.0 + frame / 64.0;
        const std::vector<std::byte> one = at(early, time);
        ASSERT_EQ(one, at(late, years + time)) << "frame " << frame;
        EXPECT_NE(one, before) << "frame " << frame << " has not moved";
        before = one;
    }
}

TEST_F(GrassTimeTest, WhereItFallsBladesSettleInTheWindOfTheNewTime)
{
    Grass grass(context(), oneSlot_);
    grass.add({resident_, {}});
    const std::size_t grassy = apartFromNew(std::vector<std::byte>(at(grass, 51.0).size()), 51.0);
    ASSERT_GT(grassy, 500u);
    // Waves apart, so that the wind is another.
    const std::vector<std::byte> fallen = at(grass, 9.5);
    EXPECT_GT(apartFromNew(fallen, 51.0), grassy / 10) << "the wind is no other";
    EXPECT_LT(apartFromNew(fallen, 9.5), grassy / 50);
    // It moves on from there at once.
    EXPECT_NE(at(grass, 9.5 + 1.0 / 64.0), fallen);
    // So it does after a step that is longer than blades are moved by.
    EXPECT_LT(apartFromNew(at(grass, years + 51.0), years + 51.0), grassy / 50);
}

} // namespace
} // namespace sward::render
