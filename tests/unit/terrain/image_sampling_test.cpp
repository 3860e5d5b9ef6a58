#include "core/error.h"
#include "terrain/image/channel_image.h"
#include "terrain/image/image_sampling.h"
#include "unit/terrain/image_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace sward::terrain {
namespace {

// A folder of its own, gone at the end.
class ChannelImages : public testing::Test {
protected:
    ChannelImages() { std::filesystem::create_directories(folder_); }
    ~ChannelImages() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& bytes)
    {
        const std::filesystem::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    testing::UnitTest::GetInstance()->current_test_info()->name();
};

// An uncompressed TGA of 3 or 4 channels, pixels as blue, green, red, alpha, rows from the top.
std::string tga(std::uint8_t width, std::uint8_t height, int channels,
                const std::vector<std::uint8_t>& pixels)
{
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width);
    bytes[14] = static_cast<char>(height);
    bytes[16] = static_cast<char>(8 * channels);
    bytes[17] = static_cast<char>(channels == 4 ? 0x28 : 0x20);
    for (const std::uint8_t value : pixels)
        bytes += static_cast<char>(value);
    return bytes;
}

TEST_F(ChannelImages, KeepSixteenBitsAndSpreadEight)
{
    const ChannelImage deep =
        readChannel(write("deep.png", greyPng({2, 2}, {0, 1, 40'000, 65'535}, 16)), 0);
    EXPECT_EQ(deep.values, (std::vector<std::uint16_t>{0, 1, 40'000, 65'535}));
    const ChannelImage flat = readChannel(write("flat.png", greyPng({3, 1}, {0, 51, 255}, 8)), 2);
    EXPECT_EQ(flat.values, (std::vector<std::uint16_t>{0, 51 * 257, 65'535}));
    EXPECT_EQ(flat.width, 3U);
    EXPECT_EQ(flat.height, 1U);
}

TEST_F(ChannelImages, TakeTheChannelAskedFor)
{
    const std::string file = write("four.tga", tga(2, 1, 4, {3, 2, 1, 4, 30, 20, 10, 40}));
    for (int channel = 0; channel < 4; ++channel) {
        const ChannelImage image = readChannel(file, channel);
        const auto first = static_cast<std::uint16_t>(257 * (channel + 1));
        EXPECT_EQ(image.values,
                  (std::vector<std::uint16_t>{first, static_cast<std::uint16_t>(10 * first)}))
            << channel;
    }
}

TEST_F(ChannelImages, SayWhatIsWrong)
{
    const auto complaint = [](const std::string& file, int channel) {
        try {
            readChannel(file, channel);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(complaint(write("a.tga", tga(1, 1, 3, {1, 2, 3})), 3).find("no alpha"),
              std::string::npos);
    EXPECT_NE(complaint(write("grey.png", greyPng({1, 1}, {7}, 8)), 3).find("no alpha"),
              std::string::npos);
    EXPECT_NE(complaint(write("text.png", "not an image at all"), 0).find("text.png"),
              std::string::npos);
    std::string cut = greyPng({64, 64}, std::vector<std::uint16_t>(4096, 9), 16);
    cut.resize(cut.size() / 2);
    EXPECT_NE(complaint(write("cut.png", cut), 0), "");
    EXPECT_NE(complaint(write("huge.tga",
                              [] {
                                  std::string header = tga(0, 0, 3, {});
                                  header[12] = header[13] = header[14] = header[15] = '\xff';
                                  return header;
                              }()),
                        0)
                  .find("pixels"),
              std::string::npos);
}

TEST(ImageSampling, GoesOnOutsideAsItIsTold)
{
    // Pixels of a plane around an image of three.
    const auto row = [](ImageWrap wrap) {
        std::vector<std::size_t> numbers;
        for (std::int64_t i = -4; i < 7; ++i)
            numbers.push_back(wrapped(i, 3, wrap));
        return numbers;
    };
    using Numbers = std::vector<std::size_t>;
    EXPECT_EQ(row(ImageWrap::repeat), (Numbers{2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0}));
    EXPECT_EQ(row(ImageWrap::clamp), (Numbers{0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2}));
    EXPECT_EQ(row(ImageWrap::mirror), (Numbers{2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0}));
}

TEST(ImageSampling, IsExactInTheMiddleOfPixelsAndLinearBetween)
{
    GroundImage image{"", 4, 1, {0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0}};
    const auto at = [&](double u, ImageWrap wrap) {
        return valueAt(image, 0, {wrap, ImageWrap::repeat}, {u, 0.3});
    };
    for (const ImageWrap wrap : {ImageWrap::repeat, ImageWrap::clamp, ImageWrap::mirror}) {
        EXPECT_DOUBLE_EQ(at(0.125, wrap), 0.0);
        EXPECT_DOUBLE_EQ(at(0.375, wrap), 1.0);
        EXPECT_DOUBLE_EQ(at(0.4375, wrap), 0.75);
    }
    EXPECT_DOUBLE_EQ(at(0.0, ImageWrap::repeat), 0.5);
    EXPECT_DOUBLE_EQ(at(0.0, ImageWrap::clamp), 0.0);
    EXPECT_DOUBLE_EQ(at(1.125, ImageWrap::mirror), 1.0);
    EXPECT_DOUBLE_EQ(at(1.125, ImageWrap::repeat), 0.0);
    EXPECT_DOUBLE_EQ(at(3e30, ImageWrap::clamp), 1.0);
    EXPECT_DOUBLE_EQ(at(-3e30, ImageWrap::clamp), 0.0);
    EXPECT_GE(at(3e30, ImageWrap::mirror), 0.0);
    EXPECT_GE(at(-3e30, ImageWrap::repeat), 0.0);
}

} // namespace
} // namespace sward::terrain
