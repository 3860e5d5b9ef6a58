#include "apps/lidar/beam_file.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/files/mapped_file.h"
#include "core/lower_case.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

namespace sward::apps {
namespace {

using Row = std::array<double, 6>;

constexpr double farthestPlace = 1e12;        // [m]
constexpr double shortestDirection = 1e-9;    // [m]
constexpr std::size_t largestText = 1u << 30; // [bytes] of a .csv
constexpr std::size_t largestNumpyHeader = 1u << 16;
constexpr const char* columnNames[] = {"x", "y", "z", "dx", "dy", "dz"};

bool isBeam(const Row& row)
{
    return std::ranges::all_of(row, [](double one) { return std::abs(one) <= farthestPlace; }) &&
           glm::length(glm::dvec3(row[3], row[4], row[5])) > shortestDirection;
}

lidar::Beam beamOf(const Row& row, const std::string& path, const char* what, std::uint64_t number)
{
    for (std::size_t i = 0; i < row.size(); ++i)
        if (!(std::abs(row[i]) <= farthestPlace))
            fail(ErrorKind::input, "{}: {} {}: {} is {}; allowed is {:g} to {:g}", path, what,
                 number, columnNames[i], row[i], -farthestPlace, farthestPlace);
    const glm::dvec3 towards(row[3], row[4], row[5]);
    const double length = glm::length(towards);
    if (!(length > shortestDirection))
        fail(ErrorKind::input, "{}: {} {}: dx dy dz are {}, {}, {}, which is no direction", path,
             what, number, row[3], row[4], row[5]);
    return {{row[0], row[1], row[2]}, glm::vec3(towards / length)};
}

// What stands behind "'key':" in the header of a .npy, up to the next key.
std::string_view headerValue(std::string_view header, std::string_view key)
{
    const std::size_t at = header.find(key);
    if (at == std::string_view::npos)
        return {};
    const std::string_view rest = header.substr(at + key.size());
    return rest.substr(0, rest.find('}'));
}

lidar::Beams readNumpy(const std::string& path)
{
    const auto file = std::make_shared<const MappedFile>(path);
    const std::span<const std::byte> bytes = file->bytes();
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    if (bytes.size() < 12 || std::memcmp(text, "\x93NUMPY", 6) != 0)
        fail(ErrorKind::input, "{}: does not begin as a .npy file of NumPy", path);
    const bool isFirst = bytes[6] == std::byte(1);
    std::size_t headerSize =
        std::to_integer<std::size_t>(bytes[8]) | std::to_integer<std::size_t>(bytes[9]) << 8;
    if (!isFirst)
        headerSize |= std::to_integer<std::size_t>(bytes[10]) << 16 |
                      std::to_integer<std::size_t>(bytes[11]) << 24;
    const std::size_t begin = isFirst ? 10 : 12;
    if (headerSize > largestNumpyHeader || bytes.size() - begin < headerSize)
        fail(ErrorKind::input, "{}: its header of {} bytes is longer than the file or {} bytes",
             path, headerSize, largestNumpyHeader);
    const std::string_view header(text + begin, headerSize);
    const std::string_view type = headerValue(header, "'descr':");
    const bool isDouble = type.find("'<f8'") < type.find(',');
    if (!isDouble && !(type.find("'<f4'") < type.find(',')))
        fail(ErrorKind::unsupported,
             "{}: its numbers are no little-endian float32 or float64; save it with astype('<f8')",
             path);
    if (headerValue(header, "'fortran_order':").find("False") == std::string_view::npos)
        fail(ErrorKind::unsupported,
             "{}: is in Fortran order; save it with numpy.ascontiguousarray()", path);
    const std::string_view shape = headerValue(header, "'shape':");
    std::uint64_t rows = 0, columns = 0;
    const std::size_t open = shape.find('('), comma = shape.find(',');
    if (open != std::string_view::npos && comma != std::string_view::npos) {
        std::from_chars(shape.data() + open + 1, shape.data() + shape.size(), rows);
        std::string_view second = shape.substr(comma + 1);
        second.remove_prefix(std::min(second.find_first_not_of(' '), second.size()));
        std::from_chars(second.data(), second.data() + second.size(), columns);
        if (second.find(',') < second.find(')'))
            columns = 0; // a third dimension
    }
    if (columns != 6)
        fail(ErrorKind::input, "{}: its shape is not (N, 6): x y z dx dy dz", path);
    const std::size_t size = isDouble ? 8 : 4;
    const std::size_t data = begin + headerSize;
    if (rows != (bytes.size() - data) / (6 * size))
        fail(ErrorKind::input, "{}: has {} rows by its header, and bytes of {}", path, rows,
             (bytes.size() - data) / (6 * size));
    const auto rowAt = [file, data, isDouble, size](std::uint64_t number) {
        const std::byte* const at = file->bytes().data() + data + number * 6 * size;
        Row row;
        std::array<float, 6> singles;
        if (isDouble)
            std::memcpy(row.data(), at, sizeof row);
        else {
            std::memcpy(singles.data(), at, sizeof singles);
            std::copy(singles.begin(), singles.end(), row.begin());
        }
        return row;
    };
    return {rows, [rowAt, path](std::uint64_t number) {
                const Row row = rowAt(number);
                if (!isBeam(row))
                    // Rows are read in any order: name the first wrong one.
                    for (std::uint64_t first = 0; first < number; ++first)
                        static_cast<void>(beamOf(rowAt(first), path, "row", first));
                return beamOf(row, path, "row", number);
            }};
}

std::vector<std::string_view> cellsOf(std::string_view line)
{
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        std::string_view cell = line.substr(0, comma);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t'))
            cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r'))
            cell.remove_suffix(1);
        // Quotes as RFC 4180 has them; neither names of columns nor numbers hold commas.
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        cells.push_back(cell);
        if (comma == std::string_view::npos)
            return cells;
        line.remove_prefix(comma + 1);
    }
}

lidar::Beams readTable(const std::string& path)
{
    const std::vector<std::byte> bytes = readFile(path, largestText);
    refuseForeign(bytes, path);
    std::string_view rest =
        withoutMark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const auto rows = std::make_shared<std::vector<lidar::Beam>>();
    std::array<std::size_t, 6> places{};
    std::size_t width = 0;
    for (std::uint64_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        const std::vector<std::string_view> cells = cellsOf(text);
        if (cells.size() == 1 && cells.front().empty())
            continue;
        if (width == 0) {
            width = cells.size();
            for (std::size_t i = 0; i < places.size(); ++i) {
                const auto found = std::find(cells.begin(), cells.end(), columnNames[i]);
                if (found == cells.end())
                    fail(ErrorKind::input,
                         "{}: line {} names no column {}; a header x,y,z,dx,dy,dz is needed", path,
                         line, columnNames[i]);
                places[i] = static_cast<std::size_t>(found - cells.begin());
            }
            continue;
        }
        if (cells.size() != width)
            fail(ErrorKind::input, "{}: line {} has {} cells; the header has {}", path, line,
                 cells.size(), width);
        Row row;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string_view cell = cells[places[i]];
            // std::from_chars() takes no plus.
            const bool hasPlus = cell.starts_with('+') && !cell.starts_with("+-");
            const auto [stop, error] =
                std::from_chars(cell.data() + (hasPlus ? 1 : 0), cell.data() + cell.size(), row[i]);
            if (error != std::errc() || stop != cell.data() + cell.size())
                fail(ErrorKind::input, "{}: line {}: {} is '{}', which is no number", path, line,
                     columnNames[i], cell);
        }
        rows->push_back(beamOf(row, path, "line", line));
    }
    if (width == 0)
        fail(ErrorKind::input, "{}: is empty; a header x,y,z,dx,dy,dz is needed", path);
    return {rows->size(), [rows](std::uint64_t number) { return (*rows)[number]; }};
}

} // namespace

lidar::Beams readBeams(const std::string& path)
{
    const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
    if (extension != ".npy" && extension != ".csv")
        fail(ErrorKind::usage, "--beams: '{}' is neither .npy nor .csv", path);
    return extension == ".npy" ? readNumpy(path) : readTable(path);
}

} // namespace sward::apps
