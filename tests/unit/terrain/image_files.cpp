#include "unit/terrain/image_files.h"

#include "core/expect.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <png.h>

#include <algorithm>

namespace sward::terrain {
namespace {

void appendBytes(png_structp png, png_bytep bytes, std::size_t size)
{
    static_cast<std::string*>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char*>(bytes), size);
}

class StringStream final : public Imf::OStream {
public:
    StringStream()
        : Imf::OStream("memory")
    {
    }

    void write(const char bytes[], int size) override
    {
        const auto count = static_cast<std::size_t>(size);
        text.resize(std::max(text.size(), at_ + count));
        std::copy_n(bytes, count, text.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += count;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override { at_ = at; }

    std::string text;

private:
    std::size_t at_ = 0;
};

} // namespace

std::string greyPng(const glm::uvec2& size, const std::vector<std::uint16_t>& samples, int depth,
                    bool interlaced)
{
    expect(samples.size() == std::size_t(size.x) * size.y, "a sample for each pixel");
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, appendBytes, nullptr);
    png_set_IHDR(png, info, size.x, size.y, depth, PNG_COLOR_TYPE_GRAY,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);

    // Big-endian, as PNG has it.
    const std::size_t bytes = depth == 16 ? 2 : 1;
    std::vector<png_byte> pixels;
    for (const std::uint16_t sample : samples) {
        if (bytes == 2)
            pixels.push_back(static_cast<png_byte>(sample >> 8));
        pixels.push_back(static_cast<png_byte>(sample & 0xffU));
    }
    std::vector<png_bytep> rows;
    for (std::size_t j = 0; j < size.y; ++j)
        rows.push_back(pixels.data() + j * size.x * bytes);
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return file;
}

std::string colorPng(const glm::uvec2& size, int channels, const std::vector<std::uint8_t>& bytes)
{
    const std::size_t rowBytes = std::size_t(size.x) * static_cast<std::size_t>(channels);
    expect(bytes.size() == rowBytes * size.y, "a byte for each sample");
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, appendBytes, nullptr);
    const int type = channels == 2   ? PNG_COLOR_TYPE_GRAY_ALPHA
                     : channels == 3 ? PNG_COLOR_TYPE_RGB
                                     : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_IHDR(png, info, size.x, size.y, 8, type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    png_write_info(png, info);
    for (std::size_t j = 0; j < size.y; ++j)
        png_write_row(png, bytes.data() + j * rowBytes);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return file;
}

std::string floatExr(const glm::uvec2& size, const std::vector<float>& samples, const ExrLook& look)
{
    expect(samples.size() == std::size_t(size.x) * size.y, "a sample for each pixel");
    Imf::Header header(static_cast<int>(size.x), static_cast<int>(size.y));
    const Imf::PixelType type = look.isHalf ? Imf::HALF : Imf::FLOAT;
    header.channels().insert(look.channel, Imf::Channel(type));
    const std::vector<half> halves(samples.begin(), samples.end());
    Imf::FrameBuffer buffer;
    buffer.insert(look.channel, look.isHalf
                                    ? Imf::Slice::Make(type, halves.data(), header.dataWindow())
                                    : Imf::Slice::Make(type, samples.data(), header.dataWindow()));
    if (!look.alpha.empty()) {
        expect(look.alpha.size() == samples.size(), "an alpha for each pixel");
        header.channels().insert("A", Imf::Channel(Imf::FLOAT));
        buffer.insert("A", Imf::Slice::Make(Imf::FLOAT, look.alpha.data(), header.dataWindow()));
    }
    StringStream stream;
    if (look.isTiled) {
        header.setTileDescription(Imf::TileDescription(16, 16));
        Imf::TiledOutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(size.y));
    }
    return stream.text;
}

std::string rawHeights(const std::vector<std::uint16_t>& samples)
{
    std::string file;
    for (const std::uint16_t sample : samples) {
        file.push_back(static_cast<char>(sample & 0xffU));
        file.push_back(static_cast<char>(sample >> 8));
    }
    return file;
}

} // namespace sward::terrain
