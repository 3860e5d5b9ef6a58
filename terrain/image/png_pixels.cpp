#include "terrain/image/png_pixels.h"

#include "core/error.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>

namespace sward::terrain {
namespace {

constexpr png_uint_32 sideLimit = 1U << 20; // the caller checks a tighter bound

constexpr std::size_t tailLimit = 65536; // after the last row [bytes]

// Memory limit of libpng for text, profiles and the like, which ground does not use.
constexpr png_alloc_size_t chunkLimit = 1U << 20;

// libpng reports errors by longjmp. Nothing between setjmp and here may have a destructor, so every
// step is a separate function on plain members.
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

    // Each step returns whether it succeeded.
    bool readHeader()
    {
        if (png_ == nullptr || info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_user_limits(png_, sideLimit, sideLimit);
        png_set_chunk_malloc_max(png_, chunkLimit);
        png_set_read_fn(png_, this, onRead);
        png_read_info(png_, info_);
        return true;
    }

    glm::uvec2 size() const
    {
        return {png_get_image_width(png_, info_), png_get_image_height(png_, info_)};
    }
    std::size_t depth() const { return png_get_bit_depth(png_, info_); }

    bool expand(PngForm form)
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        png_set_expand(png_);
        if (form == PngForm::rgba) {
            png_set_strip_16(png_);
            png_set_gray_to_rgb(png_);
            png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
        } else {
            png_set_strip_alpha(png_);
            png_set_swap(png_);
        }
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    std::size_t channels() const { return png_get_channels(png_, info_); }
    std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }

    bool read(std::vector<png_bytep>& rows)
    {
        if (setjmp(png_jmpbuf(png_)) != 0)
            return false;
        for (int pass = 0; pass < passes_; ++pass)
            for (std::size_t j = 0; j < rows.size(); ++j) {
                // After the last row, libpng unpacks all remaining data, possibly gigabytes.
                if (pass + 1 == passes_ && j + 1 == rows.size())
                    limit_ = at_ + 2 * rowBytes() + tailLimit;
                png_read_row(png_, rows[j], nullptr);
            }
        if (file_.size() - at_ <= tailLimit)
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
        if (own.at_ + size > own.limit_)
            png_error(png, "it goes on behind its last row");
        std::memcpy(to, own.file_.data() + own.at_, size);
        own.at_ += size;
    }

    std::span<const std::byte> file_;
    std::size_t at_ = 0;
    std::size_t limit_ = ~std::size_t(0); // of input that may be read
    int passes_ = 1;
    std::array<char, 128> reason_{};
    png_structp png_;
    png_infop info_;
};

} // namespace

bool isPng(std::span<const std::byte> file)
{
    return file.size() >= 8 &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, 8) == 0;
}

PngPixels readPng(std::span<const std::byte> file, PngForm form,
                  const std::function<void(const glm::uvec2&)>& check, const std::string& place)
{
    PngReader reader(file);
    const auto demand = [&](bool done) {
        if (!done)
            fail(ErrorKind::input, "{}: not a PNG that can be read: {}", place, reader.reason());
    };
    demand(reader.readHeader());
    PngPixels pixels;
    pixels.size = reader.size();
    check(pixels.size);
    pixels.depth = reader.depth();
    pixels.isWide = pixels.depth == 16 && form == PngForm::stored;
    demand(reader.expand(form));
    pixels.channels = reader.channels();

    const std::size_t rowBytes = reader.rowBytes();
    pixels.bytes.resize(rowBytes * pixels.size.y);
    std::vector<png_bytep> rows(pixels.size.y);
    for (std::size_t j = 0; j < rows.size(); ++j)
        rows[j] = pixels.bytes.data() + j * rowBytes;
    demand(reader.read(rows));
    return pixels;
}

} // namespace sward::terrain
