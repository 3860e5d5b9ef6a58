#include "core/error.h"
#include "core/foreign_bytes.h"
#include "core/lower_case.h"
#include "terrain/heightmap/height_samples.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

// Reads the words of a grid.
class AscWords {
public:
    explicit AscWords(std::string_view text)
        : text_(text)
    {
    }

    // The next word; empty at the end.
    std::string_view next()
    {
        while (at_ < text_.size() && isGap(text_[at_]))
            ++at_;
        const std::size_t begin = at_;
        while (at_ < text_.size() && !isGap(text_[at_]))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }

    std::size_t offset() const { return at_; }
    void goTo(std::size_t offset) { at_ = offset; }

private:
    static bool isGap(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    std::string_view text_;
    std::size_t at_ = 0;
};

std::optional<double> ascNumber(std::string_view word)
{
    if (!word.empty() && word.front() == '+')
        word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        return std::nullopt;
    return value;
}

struct AscHeader {
    double columns = 0.0;
    double rows = 0.0;
    double cellSize = 0.0;
    double noData = -9999.0;
};

// Reads keys and numbers until a line begins with a number.
AscHeader readAscHeader(AscWords& words, const std::string& place)
{
    AscHeader header;
    while (true) {
        const std::size_t begin = words.offset();
        const std::string key = lowerCase(std::string(words.next()));
        if (key.empty() || ascNumber(key)) {
            words.goTo(begin);
            return header;
        }
        const std::string_view word = words.next();
        const std::optional<double> value = ascNumber(word);
        if (!value)
            fail(ErrorKind::input, "{}: {} is \"{}\", not a number", place, key.substr(0, 32),
                 word.substr(0, 32));
        if (key == "ncols")
            header.columns = *value;
        else if (key == "nrows")
            header.rows = *value;
        else if (key == "cellsize" || key == "dx")
            header.cellSize = *value;
        else if (key == "nodata_value")
            header.noData = *value;
        else if (key != "xllcorner" && key != "yllcorner" && key != "xllcenter" &&
                 key != "yllcenter" && key != "dy")
            fail(ErrorKind::input, "{}: \"{}\" is no key of an ESRI ASCII grid", place,
                 key.substr(0, 32));
    }
}

} // namespace

HeightSamples readAscHeights(std::string_view file, const std::string& place,
                             Diagnostics& diagnostics)
{
    AscWords words(withoutMark(file));
    const AscHeader header = readAscHeader(words, place);
    for (const double count : {header.columns, header.rows})
        if (!(count >= 0.0 && count <= 1e9 && count == std::floor(count)))
            fail(ErrorKind::input, "{}: ncols {} and nrows {} are not counts", place,
                 header.columns, header.rows);
    const auto width = static_cast<std::uint32_t>(header.columns);
    const auto height = static_cast<std::uint32_t>(header.rows);
    requireHeightmapSize(width, height, place);
    const std::size_t count = std::size_t(width) * height;
    if (count > file.size())
        fail(ErrorKind::input, "{}: truncated: {} samples do not fit {} bytes", place, count,
             file.size());

    HeightSamples samples;
    samples.size = {width, height};
    samples.isMetric = true;
    samples.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = words.next();
        const std::optional<double> value = ascNumber(word);
        if (!value)
            fail(ErrorKind::input, "{}: sample {} of {}: \"{}\" is not a number, or the file ends",
                 place, i, count, word.substr(0, 32));
        samples.values.push_back(*value == header.noData ? std::numeric_limits<float>::quiet_NaN()
                                                         : static_cast<float>(*value));
    }
    dropNoData(samples, place, diagnostics);
    // Cells of less than this are degrees of a geographic grid.
    constexpr double minMetres = 0.05;
    if (header.cellSize >= minMetres)
        samples.step = header.cellSize;
    else if (header.cellSize > 0.0)
        diagnostics.warn(
            "{}: its cellsize {} seems to be in degrees and is not used; give --extent", place,
            header.cellSize);
    return samples;
}

} // namespace sward::terrain
