#include "terrain/image/png_pixels.h"

#include "core/error.h"
#include "terrain/image/png_chunks.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace sward::terrain {
namespace {

constexpr png_uint_32 sideLimit = 1U << 20; // the caller checks a tighter bound

constexpr std::size_t tailLimit = 65536; // after the last row [bytes]

// Pixels of more bytes than this, and than so many times the file, are allocated only after a trial
// has unpacked all rows into one.
constexpr std::size_t trustedBytes = std::size_t(32) << 20;
constexpr std::size_t trustedRatio = 32;

// Why libpng stopped, in plain words.
struct Trouble {
    std::string_view theirs; // part of libpng's text
    const char* ours;
};
constexpr std::array<Trouble, 12> troubles{{
    {"it goes on", "it goes on behind its last row"},
    {"ot enough", "truncated: its pixel data end before the last row"},
    {"truncated", "truncated: its pixel data end before the last row"},
    {"unexpected end", "truncated: its pixel data end before the last row"},
    {"CRC", "damaged: a chunk does not match its checksum"},
    {"IHDR", "damaged: its header (IHDR) is not valid"},
    {"image width", "damaged: its header (IHDR) is not valid"},
    {"PLTE", "damaged: its palette is missing or not valid"},
    {"palette", "damaged: its palette is missing or not valid"},
    {"tRNS", "damaged: its transparency (tRNS) is not valid"},
    {"filter", "damaged: a row has an unknown filter"},
    {"emory", "not enough memory for it"},
}};

std::string_view inPlainWords(std::string_view theirs)
{
    for (const Trouble& one : troubles)
        if (theirs.find(one.theirs) != std::string_view::npos)
            return one.ours;
    return "damaged: its pixel data cannot be unpacked";
}

// libpng reports errors by longjmp. Nothing between setjmp and here may have a destructor, so every
// step is a separate function on plain members.
class PngReader {
public:
    using Parts = std::vector<std::span<const std::byte>>;

    explicit PngReader(const Parts& parts)
        : parts_(parts)
        , png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning))
        , info_(png_ == nullptr ? nullptr : png_create_info_struct(png_))
    {
        for (const std::span<const std::byte> part : parts_)
            left_ += part.size();
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    // Each step returns whether it succeeded.
    bool readHeader()
    {
        if (png_ == nullptr || info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_user_limits(png_, sideLimit, sideLimit);
        png_set_read_fn(png_, this, onRead);
        png_read_info(png_, info_);
        return true;
    }

    glm::uvec2 size() const
    {
        return {png_get_image_width(png_, info_), png_get_image_height(png_, info_)};
    }
    std::size_t depth() const { return png_get_bit_depth(png_, info_); }
    bool hasPalette() const
    {
        return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE;
    }

    // Indices of a palette stay as they are, a byte each.
    bool expand(PngForm form)
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        if (hasPalette()) {
            png_set_packing(png_);
        } else {
            png_set_expand(png_);
            if (form == PngForm::rgba) {
                png_set_strip_16(png_);
                png_set_gray_to_rgb(png_);
                png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
            } else {
                png_set_swap(png_);
            }
        }
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    std::size_t channels() const { return png_get_channels(png_, info_); }
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }

    // Reads `count` rows to `rows` on, `step` bytes apart; 0: all into the same.
    bool read(png_bytep rows, std::size_t step, std::size_t count)
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        for (int pass = 0; pass < passes_; ++pass)
            for (std::size_t j = 0; j < count; ++j) {
                // After the last row, libpng unpacks all remaining data, possibly gigabytes.
                if (pass + 1 == passes_ && j + 1 == count)
                    allowed_ = 2 * rowBytes() + tailLimit;
                png_read_row(png_, rows + j * step, nullptr);
            }
        if (left_ <= tailLimit)
            png_read_end(png_, nullptr);
        return true;
    }

    // RGBA of the palette's colours; behind a palette that does not exist, nothing.
    std::vector<std::array<unsigned char, 4>> palette() const
    {
        png_colorp colors = nullptr;
        int count = 0;
        png_bytep alphas = nullptr;
        int alphaCount = 0;
        png_get_PLTE(png_, info_, &colors, &count);
        png_get_tRNS(png_, info_, &alphas, &alphaCount, nullptr);
        std::vector<std::array<unsigned char, 4>> all;
        for (int i = 0; i < count; ++i)
            all.push_back({colors[i].red, colors[i].green, colors[i].blue,
                           i < alphaCount ? alphas[i] : static_cast<unsigned char>(255)});
        return all;
    }
    bool hasTransparency() const { return png_get_valid(png_, info_, PNG_INFO_tRNS) != 0; }

    std::string_view reason() const { return inPlainWords(reason_.data()); }

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
        if (size > own.left_)
            png_error(png, "truncated");
        if (size > own.allowed_)
            png_error(png, "it goes on behind its last row");
        own.left_ -= size;
        own.allowed_ -= size;
        while (size > 0) {
            const std::span<const std::byte> rest = own.parts_[own.part_].subspan(own.at_);
            const std::size_t taken = std::min(size, rest.size());
            std::memcpy(to, rest.data(), taken);
            to += taken;
            size -= taken;
            own.at_ += taken;
            if (own.at_ == own.parts_[own.part_].size()) {
                ++own.part_;
                own.at_ = 0;
            }
        }
    }

    const Parts& parts_;
    std::size_t part_ = 0;
    std::size_t at_ = 0; // in the part
    std::size_t left_ = 0;
    std::size_t allowed_ = ~std::size_t(0); // of input that may be read
    int passes_ = 1;
    std::array<char, 128> reason_{};
    png_structp png_;
    png_infop info_;
};

void demand(bool done, const PngReader& reader, const std::string& place)
{
    if (!done)
        fail(ErrorKind::input, "{}: a PNG that cannot be read: {}", place, reader.reason());
}

// Unpacks all rows into one.
void tryRows(const PngReader::Parts& parts, PngForm form, const std::string& place)
{
    PngReader reader(parts);
    demand(reader.readHeader(), reader, place);
    demand(reader.expand(form), reader, place);
    std::vector<unsigned char> row(reader.rowBytes());
    demand(reader.read(row.data(), 0, reader.size().y), reader, place);
}

// Replaces indices by colours: RGB, or RGBA where the file has alpha or `form` wants it.
void lookUp(PngPixels& pixels, PngForm form, const PngReader& reader, const std::string& place)
{
    const std::vector<std::array<unsigned char, 4>> palette = reader.palette();
    const std::size_t channels = form == PngForm::rgba || reader.hasTransparency() ? 4 : 3;
    std::vector<unsigned char> colors(pixels.bytes.size() * channels);
    for (std::size_t i = 0; i < pixels.bytes.size(); ++i) {
        const std::size_t index = pixels.bytes[i];
        if (index >= palette.size())
            fail(ErrorKind::input,
                 "{}: the pixel in column {}, row {} has colour {} of a palette of {}", place,
                 i % pixels.size.x, i / pixels.size.x, index, palette.size());
        std::copy_n(palette[index].begin(), channels,
                    colors.begin() + static_cast<std::ptrdiff_t>(i * channels));
    }
    pixels.bytes = std::move(colors);
    pixels.channels = channels;
}

} // namespace

std::uint16_t PngPixels::at(std::size_t pixel, std::size_t channel) const
{
    const std::size_t index = pixel * channels + channel;
    if (!isWide)
        return static_cast<std::uint16_t>(257U * bytes[index]);
    std::uint16_t value = 0;
    std::memcpy(&value, bytes.data() + 2 * index, sizeof value);
    return value;
}

bool isPng(std::span<const std::byte> file)
{
    return file.size() >= 8 &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, 8) == 0;
}

PngPixels readPng(std::span<const std::byte> file, PngForm form,
                  const std::function<void(const glm::uvec2&)>& check, const std::string& place)
{
    if (!isPng(file))
        fail(ErrorKind::input, "{}: not a PNG: its first bytes are others", place);
    const PngReader::Parts parts = pngChunks(file, place);
    PngReader reader(parts);
    demand(reader.readHeader(), reader, place);
    PngPixels pixels;
    pixels.size = reader.size();
    check(pixels.size);
    pixels.depth = reader.depth();
    pixels.hasPalette = reader.hasPalette();
    pixels.isWide = pixels.depth == 16 && form == PngForm::stored;
    demand(reader.expand(form), reader, place);
    pixels.channels = reader.channels();

    const std::size_t rowBytes = reader.rowBytes();
    const std::size_t bytes = rowBytes * pixels.size.y;
    if (bytes * (pixels.hasPalette ? 4 : 1) > std::max(trustedBytes, file.size() * trustedRatio))
        tryRows(parts, form, place);
    pixels.bytes.resize(bytes);
    demand(reader.read(pixels.bytes.data(), rowBytes, pixels.size.y), reader, place);
    if (pixels.hasPalette)
        lookUp(pixels, form, reader, place);
    return pixels;
}

} // namespace sward::terrain
