#include "support/pictures/picture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace sward::golden {
namespace {

Picture grey(std::size_t width, std::size_t height)
{
    return {width, height, std::vector<std::uint8_t>(3 * width * height, 100)};
}

TEST(PictureComparison, CountsPixelsBeyondTheToleranceOnceEach)
{
    const Picture expected = grey(50, 20);
    Picture actual = expected;
    EXPECT_EQ(compare(expected, actual).differentPixels, 0u);

    // Within the tolerance in every channel.
    actual.rgb[0] = 100 + tolerance;
    actual.rgb[1] = 100 - tolerance;
    EXPECT_EQ(compare(expected, actual).differentPixels, 0u);
    EXPECT_EQ(compare(expected, actual).largest, tolerance);

    // Exceed the tolerance by one, up and down, in two channels of one pixel and one of the last.
    actual.rgb[0] = 100 + tolerance + 1;
    actual.rgb[2] = 0;
    actual.rgb.back() = 100 - tolerance - 1;
    const Difference difference = compare(expected, actual);
    EXPECT_EQ(difference.differentPixels, 2u);
    EXPECT_EQ(difference.largest, 100);
    EXPECT_DOUBLE_EQ(difference.share(), 2.0 / 1000.0);
}

TEST(PictureComparison, RefusesPicturesOfDifferentSizes)
{
    EXPECT_THROW(compare(grey(4, 2), grey(2, 4)), std::runtime_error);
}

TEST(PictureComparison, ShowsSixteenfoldWhatDiffers)
{
    const Picture expected = grey(2, 1);
    Picture actual = expected;
    actual.rgb[1] = 98;
    actual.rgb[5] = 255;
    EXPECT_EQ(amplifiedDifference(expected, actual).rgb,
              (std::vector<std::uint8_t>{0, 32, 0, 0, 0, 255}));
}

TEST(PictureFile, ComesBackAsItWasWritten)
{
    Picture picture = grey(3, 2);
    picture.rgb[4] = 7;
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "picture_file_test.png";
    writePicture(picture, path);
    const Picture back = readPicture(path);
    std::filesystem::remove(path);
    EXPECT_EQ(back.width, 3u);
    EXPECT_EQ(back.height, 2u);
    EXPECT_EQ(back.rgb, picture.rgb);
    EXPECT_THROW(readPicture(path), std::runtime_error);
}

} // namespace
} // namespace sward::golden
