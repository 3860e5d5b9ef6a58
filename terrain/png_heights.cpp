#include "core/error.h"
#include "terrain/height_samples.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>

namespace sward::terrain {
namespace {

// libpng's memory for what it keeps of text, profiles and the like; ground needs none of them.
constexpr png_alloc_size_t chunkLimit = 1U << 20;

// libpng reports by longjmp: nothing between setjmp and here may have a destructor, so every step
// is a function of its own on plain members.
class PngReader {
public:
    explicit PngReader(std::span<const std::byte> file)
        : file_(file)
        , png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning))
        , info_(png_ == nullptr ? nullptr : png_create_info_struct(png_))
    {
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    // Each says whether it could be done.
    bool readHeader()
    {
        if (png_ == nullptr || info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_user_limits(png_, heightmapSideLimit, heightmapSideLimit);
        png_set_chunk_malloc_max(png_, chunkLimit);
        png_set_read_fn(png_, this, onRead);
        png_read_info(png_, info_);
        return true;
    }

    std::uint32_t width() const { return png_get_image_width(png_, info_); }
    std::uint32_t height() const { return png_get_image_height(png_, info_); }
    std::size_t depth() const { return png_get_bit_depth(png_, info_); }

    // Every sample of `rows` in 8 or 16 bits, 16 in the machine's order.
    bool expand()
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_expand(png_);
        png_set_strip_alpha(png_);
        if (depth() == 16)
            png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    std::size_t channels() const { return png_get_channels(png_, info_); }
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }

    bool read(std::vector<png_bytep>& rows)
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_read_image(png_, rows.data());
        png_read_end(png_, nullptr);
        return true;
    }

    const char* reason() const { return reason_.data(); }

private:
    [[noreturn]] static void onError(png_structp png, png_const_charp text)
    {
        auto& own = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(own.reason_.data(), text, own.reason_.size() - 1);
        png_longjmp(png, 1);
    }

    static void onWarning(png_structp, png_const_charp) {}

    static void onRead(png_structp png, png_bytep to, std::size_t size)
    {
        auto& own = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (size > own.file_.size() - own.at_)
            png_error(png, "truncated");
        std::memcpy(to, own.file_.data() + own.at_, size);
        own.at_ += size;
    }

    std::span<const std::byte> file_;
    std::size_t at_ = 0;
    std::array<char, 128> reason_{};
    png_structp png_;
    png_infop info_;
};

float sampleAt(const unsigned char* bytes, bool isWide)
{
    std::uint16_t wide = 0;
    if (!isWide)
        return static_cast<float>(*bytes);
    std::memcpy(&wide, bytes, sizeof wide);
    return static_cast<float>(wide);
}

} // namespace

HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             bool isHeight, Diagnostics& diagnostics)
{
    PngReader reader(file);
    const auto demand = [&](bool done) {
        if (!done)
            fail(ErrorKind::input, "{}: not a PNG that can be read: {}", place, reader.reason());
    };
    demand(reader.readHeader());
    HeightSamples samples;
    samples.size = {reader.width(), reader.height()};
    requireHeightmapSize(samples.size.x, samples.size.y, place, isHeight ? 2 : 1);
    const std::size_t depth = reader.depth();
    const bool isWide = depth == 16;
    samples.full = isWide ? 65535.0 : 255.0;
    demand(reader.expand());

    const std::size_t rowBytes = reader.rowBytes();
    std::vector<unsigned char> pixels(rowBytes * samples.size.y);
    std::vector<png_bytep> rows(samples.size.y);
    for (std::size_t j = 0; j < rows.size(); ++j)
        rows[j] = pixels.data() + j * rowBytes;
    demand(reader.read(rows));

    const std::size_t channels = reader.channels();
    const std::size_t bytes = isWide ? 2 : 1;
    bool hasColors = false;
    samples.values.reserve(std::size_t(samples.size.x) * samples.size.y);
    for (const unsigned char* const row : rows)
        for (std::size_t i = 0; i < samples.size.x; ++i) {
            const unsigned char* const pixel = row + i * channels * bytes;
            float value = sampleAt(pixel, isWide);
            for (std::size_t c = 1; c < channels; ++c) {
                const float other = sampleAt(pixel + c * bytes, isWide);
                hasColors = hasColors || other != value;
                value = std::max(value, other);
            }
            samples.values.push_back(value);
        }
    if (isHeight && !isWide)
        diagnostics.warn("{}: {} bits a sample make terraces; export the heightmap with 16", place,
                         depth);
    if (isHeight && hasColors)
        diagnostics.warn("{}: an image in colour; the brightest channel is taken for the height",
                         place);
    return samples;
}

} // namespace sward::terrain
