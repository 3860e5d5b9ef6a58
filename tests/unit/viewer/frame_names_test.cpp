#include "apps/sward_view/files/frame_names.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace sward::view {
namespace {

TEST(FrameNames, PutTheFrameWhereThePatternHasItsNumber)
{
    EXPECT_EQ(FrameNames("f_%04d.png").of(7), "f_0007.png");
    EXPECT_EQ(FrameNames("f_%d.png").of(1234), "f_1234.png");
    EXPECT_EQ(FrameNames("f%%_%02d_%%.png").of(345), "f%_345_%.png");
}

TEST(FrameNames, GiveEveryFrameTheOneNameOfAPlainPath)
{
    const FrameNames names("out/50%% green.png");
    EXPECT_FALSE(names.numbered());
    EXPECT_EQ(names.of(0), "out/50% green.png");
    EXPECT_EQ(names.of(9), names.of(0));
}

TEST(FrameNames, EndInExrWhereThatIsWritten)
{
    EXPECT_TRUE(FrameNames("f_%02d.exr", true).isExr());
    EXPECT_EQ(FrameNames("f_%02d.exr", true).of(3), "f_03.exr");
    EXPECT_FALSE(FrameNames("f.exr.png", true).isExr());
    EXPECT_THROW(FrameNames("f.exr"), Error);
    EXPECT_THROW(FrameNames("f.tif", true), Error);
}

TEST(FrameNames, RefuseWhatIsNoPattern)
{
    for (const char* pattern :
         {"a.jpg", "a", "a_%s.png", "a_%.png", "a_%04x.png", "%d_%d.png", "a_%123d.png", "%"})
        EXPECT_THROW(FrameNames{pattern}, Error) << pattern;
}

} // namespace
} // namespace sward::view
