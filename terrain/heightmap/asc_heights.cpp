#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/lower_case.h"
#include "terrain/heightmap/height_samples.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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
    glm::dvec2 cell{0.0};   // along x and y
    glm::dvec2 corner{0.0}; // lower left, x and y
    double noData = -9999.0;
    std::vector<std::string> keys; // in lower case

    bool has(std::string_view key) const
    {
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    }

    // A corner of 0 0 is the origin of a drawing or a survey of its own.
    bool hasPlace() const
    {
        return (has("xllcorner") || has("xllcenter")) && (has("yllcorner") || has("yllcenter")) &&
               corner != glm::dvec2(0.0);
    }
};

// Cells of less than this are degrees of a geographic grid, whatever the rest says [m].
constexpr double minMetres = 0.05;

// Grids of the globe have no larger cells [degrees].
constexpr double maxDegrees = 1.0;

// No ground is this many times as high as it is long.
constexpr double steepest = 4.0;

// Whether a cell is a whole number of arc minutes that no one writes in metres, as 0.0833333.
bool isArcMinutes(double cell)
{
    const double minutes = cell * 60.0;
    const double hundredths = cell * 100.0;
    return std::fabs(minutes - std::round(minutes)) < 1e-3 && std::round(minutes) >= 1.0 &&
           std::fabs(hundredths - std::round(hundredths)) > 1e-3;
}

// Whether the cells are degrees of longitude and latitude: the header places the grid on the globe,
// and in metres it would be steeper than ground is.
bool isInDegrees(const AscHeader& header, const HeightSamples& samples)
{
    const double shortest = std::min(header.cell.x, header.cell.y);
    if (!(shortest > 0.0))
        return false;
    if (shortest < minMetres)
        return true;
    if (!header.hasPlace() || std::max(header.cell.x, header.cell.y) > maxDegrees)
        return false;
    const glm::dvec2 extent = header.cell * glm::dvec2(samples.size);
    const glm::dvec2 far = header.corner + extent;
    constexpr double slack = 1.0;
    if (header.corner.x < -180.0 - slack || far.x > 360.0 + slack ||
        header.corner.y < -90.0 - slack || far.y > 90.0 + slack)
        return false;
    return reliefOf(samples) > steepest * std::max(extent.x, extent.y) ||
           isArcMinutes(header.cell.x) || isArcMinutes(header.cell.y);
}

// The grid is not square in metres: names its true size.
void warnOfDegrees(const AscHeader& header, const glm::uvec2& size, const std::string& place,
                   Diagnostics& diagnostics)
{
    const glm::dvec2 degrees = header.cell * glm::dvec2(size - 1U);
    const double middle = header.corner.y + 0.5 * degrees.y;
    const bool isOnGlobe = std::fabs(middle) < 89.0;
    diagnostics.warn(
        "{}: its cells of {:.6g} x {:.6g} seem to be in degrees and are not used; give --extent{}",
        place, header.cell.x, header.cell.y,
        isOnGlobe ? fmt::format(": about {:.0f} {:.0f} at latitude {:.4g}",
                                degrees.x * metresOfLongitude(middle), degrees.y * metresOfLatitude,
                                middle)
                  : std::string());
}

// Words of the first line of numbers, to name what does not fit.
std::size_t wordsOfLine(std::string_view text, std::size_t at)
{
    while (at < text.size() && (text[at] == ' ' || (text[at] >= '\t' && text[at] <= '\r')))
        ++at;
    AscWords words(text.substr(at, text.find('\n', at) - at));
    std::size_t count = 0;
    while (!words.next().empty())
        ++count;
    return count;
}

// Lines that are neither rows nor parts or bundles of rows shear the terrain.
void warnOfLines(std::size_t inLine, const HeightSamples& samples, const std::string& place,
                 Diagnostics& diagnostics)
{
    const std::size_t columns = samples.size.x;
    if (inLine == columns || inLine < 2 || inLine >= samples.values.size())
        return;
    if (inLine != samples.size.y && (columns % inLine == 0 || inLine % columns == 0))
        return;
    diagnostics.warn("{}: its first line has {} numbers where ncols is {}: the terrain is sheared "
                     "unless its rows really have {}{}",
                     place, inLine, columns, columns,
                     inLine == samples.size.y ? "; ncols and nrows seem to be exchanged" : "");
}

// Reads keys and numbers until a line begins with a number.
AscHeader readAscHeader(AscWords& words, std::string_view text, const std::string& place)
{
    AscHeader header;
    while (true) {
        const std::size_t begin = words.offset();
        const std::string key = lowerCase(std::string(words.next()));
        if (key.empty() || ascNumber(key)) {
            words.goTo(begin);
            return header;
        }
        const std::size_t end = words.offset();
        if (header.has(key))
            fail(ErrorKind::input, "{}: line {}: {} is given twice", place,
                 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(end), '\n'),
                 key.substr(0, 32));
        const std::string_view word = words.next();
        const std::optional<double> value = ascNumber(word);
        if (!value)
            fail(ErrorKind::input, "{}: {} is \"{}\", not a number", place, key.substr(0, 32),
                 word.substr(0, 32));
        if (key == "ncols")
            header.columns = *value;
        else if (key == "nrows")
            header.rows = *value;
        else if (key == "cellsize")
            header.cell = glm::dvec2(*value);
        else if (key == "dx")
            header.cell.x = *value;
        else if (key == "dy")
            header.cell.y = *value;
        else if (key == "xllcorner" || key == "xllcenter")
            header.corner.x = *value;
        else if (key == "yllcorner" || key == "yllcenter")
            header.corner.y = *value;
        else if (key == "nodata_value")
            header.noData = *value;
        else
            fail(ErrorKind::input, "{}: \"{}\" is no key of an ESRI ASCII grid", place,
                 key.substr(0, 32));
        header.keys.push_back(key);
    }
}

} // namespace

HeightSamples readAscHeights(std::string_view file, const std::string& place,
                             Diagnostics& diagnostics)
{
    const std::string_view text = withoutMark(file);
    AscWords words(text);
    const AscHeader header = readAscHeader(words, text, place);
    for (const char* const key : {"ncols", "nrows"})
        if (!header.has(key))
            fail(ErrorKind::input, "{}: {} is missing", place, key);
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
    const std::size_t inLine = wordsOfLine(text, words.offset());
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = words.next();
        const std::optional<double> value = ascNumber(word);
        if (word.empty() || word == "\x1a")
            fail(ErrorKind::input, "{}: truncated: {} numbers where {} columns and {} rows need {}",
                 place, i, width, height, count);
        if (!value)
            fail(ErrorKind::input, "{}: sample {} of {}: \"{}\" is not a number", place, i, count,
                 word.substr(0, 32));
        samples.values.push_back(*value == header.noData ? std::numeric_limits<float>::quiet_NaN()
                                                         : static_cast<float>(*value));
    }
    // An end mark of old systems is none of the numbers.
    std::size_t more = 0;
    for (std::string_view word = words.next(); !word.empty() && word != "\x1a"; word = words.next())
        ++more;
    if (more > 0)
        fail(ErrorKind::input,
             "{}: {} numbers are left over behind the {} of {} columns and {} rows; its first line "
             "has {}",
             place, more, count, width, height, inLine);
    warnOfLines(inLine, samples, place, diagnostics);
    dropNoData(samples, place, diagnostics);
    if (isInDegrees(header, samples))
        warnOfDegrees(header, samples.size, place, diagnostics);
    else if (header.cell.x > 0.0 && header.cell.y > 0.0)
        samples.step = header.cell;
    else if (!header.has("cellsize") && header.has("dx") != header.has("dy"))
        diagnostics.warn("{}: {} is missing, so that the size of its cells is not used; give "
                         "--extent",
                         place, header.has("dx") ? "dy" : "dx");
    else if (header.cell != glm::dvec2(0.0))
        diagnostics.warn("{}: its cells of {:.6g} x {:.6g} have no size and are not used; give "
                         "--extent",
                         place, header.cell.x, header.cell.y);
    return samples;
}

} // namespace sward::terrain
