#include "apps/sward/files/point_file.h"

#include "apps/common/version.h"
#include "core/error.h"
#include "core/lower_case.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace sward::apps {
namespace {

// ASPRS LAS 1.4: classes of points.
constexpr std::uint8_t groundClass = 2, lowVegetation = 3;
constexpr std::uint8_t noSpecies = 255;

constexpr std::size_t lasHeaderSize = 375, lasPointSize = 30;
constexpr double lasStep = 0.001; // [m]

std::string extensionOf(const std::string& path)
{
    return lowerCase(std::filesystem::path(path).extension().string());
}

// LAS is Z up.
glm::dvec3 lasAxes(const glm::dvec3& place)
{
    return {place.x, 0.0 - place.z, place.y};
}

template <typename T>
void putAt(std::string& bytes, std::size_t at, T value)
{
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::string numpyHeader(std::uint64_t count)
{
    std::string dictionary = "{'descr': [";
    for (const char* name : {"x", "y", "z"})
        dictionary += fmt::format("('{}', '<f8'), ", name);
    for (const char* name : {"range", "intensity", "incidence"})
        dictionary += fmt::format("('{}', '<f4'), ", name);
    for (const char* name : {"number", "returns", "class", "species"})
        dictionary += fmt::format("('{}', '|u1'), ", name);
    // The count has room for any, so that the header keeps its size.
    dictionary += fmt::format(
        "('beam', '<u8'), ('id', '<i8')], 'fortran_order': False, 'shape': ({},), }}", count);
    dictionary.resize(502, ' ');
    dictionary += '\n';
    // 10 + 502 + 1 + … is a multiple of 64, as NumPy wants it.
    dictionary.insert(dictionary.size() - 1, std::size_t(64 - (10 + dictionary.size()) % 64) % 64,
                      ' ');
    std::string header = "\x93NUMPY";
    header += '\1';
    header += '\0';
    header += static_cast<char>(dictionary.size() & 0xff);
    header += static_cast<char>(dictionary.size() >> 8);
    return header + dictionary;
}

std::string plyHeader(std::uint64_t count)
{
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment metres, Y up, world space; "
                         "incidence in degrees\n";
    // A count of ever the same length.
    header += fmt::format("element vertex {:<20}\n", count);
    for (const char* name : {"x", "y", "z"})
        header += fmt::format("property double {}\n", name);
    for (const char* name : {"range", "intensity", "incidence"})
        header += fmt::format("property float {}\n", name);
    for (const char* name : {"number", "returns", "class", "species"})
        header += fmt::format("property uchar {}\n", name);
    return header + "property double beam\nproperty double id\nend_header\n";
}

} // namespace

void requirePointName(const std::string& path)
{
    const std::string extension = extensionOf(path);
    if (extension != ".ply" && extension != ".npy" && extension != ".las")
        fail(ErrorKind::usage, "--output: '{}' is neither .ply nor .npy nor .las", path);
}

PointFile::PointFile(const std::string& path, const field::FieldView& field,
                     std::span<const std::uint8_t> species, bool overwrite)
    : path_(path)
    , field_(field)
    , species_(species)
    , file_(path, overwrite)
{
    requirePointName(path);
    const std::string extension = extensionOf(path);
    format_ = extension == ".ply" ? Format::ply : extension == ".npy" ? Format::npy : Format::las;
    file_.write(header());
}

// Once with the counts so far, to take its place, and once at the end.
std::string PointFile::header() const
{
    if (format_ == Format::ply)
        return plyHeader(count_);
    if (format_ == Format::npy)
        return numpyHeader(count_);
    std::string header(lasHeaderSize, '\0');
    std::memcpy(header.data(), "LASF", 4);
    putAt<std::uint16_t>(header, 6, 1u << 4); // a place's system of coordinates would be WKT
    header[24] = 1;
    header[25] = 4;
    const std::string tool = versionText("sward");
    std::memcpy(header.data() + 26, "sward lidar", 11);
    std::memcpy(header.data() + 58, tool.data(), std::min<std::size_t>(tool.size(), 32));
    putAt<std::uint16_t>(header, 94, lasHeaderSize);
    putAt<std::uint32_t>(header, 96, lasHeaderSize);
    header[104] = 6;
    putAt<std::uint16_t>(header, 105, lasPointSize);
    const glm::dvec3 offset = lasAxes(field_.origin);
    const glm::dvec3 low = count_ > 0 ? low_ : offset, high = count_ > 0 ? high_ : offset;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        putAt(header, 131 + 8 * at, lasStep);
        putAt(header, 155 + 8 * at, offset[axis]);
        putAt(header, 179 + 16 * at, high[axis]);
        putAt(header, 187 + 16 * at, low[axis]);
    }
    putAt(header, 247, count_);
    for (std::size_t number = 0; number < ofNumber_.size(); ++number)
        putAt(header, 255 + 8 * number, ofNumber_[number]);
    return header;
}

// A ribbon belongs to the stalk before it.
std::size_t PointFile::rootedRow(std::uint32_t blade) const
{
    std::size_t row = blade;
    while (row > 0 && field_.isRibbon(row))
        --row;
    return row;
}

template <typename T>
void PointFile::put(T value)
{
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
}

void PointFile::addLas(const trace::LidarReturn& point)
{
    const glm::dvec3 offset = lasAxes(field_.origin);
    const glm::dvec3 place = lasAxes(point.place);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double steps = std::round((place[axis] - offset[axis]) / lasStep);
        if (!(std::abs(steps) <= double(std::numeric_limits<std::int32_t>::max())))
            fail(ErrorKind::unsupported,
                 "{}: a point lies {:.0f} m from the field's origin; LAS reaches {:.0f} m in steps "
                 "of {} m",
                 path_, place[axis] - offset[axis],
                 std::numeric_limits<std::int32_t>::max() * lasStep, lasStep);
        put(static_cast<std::int32_t>(steps));
        const double stored = offset[axis] + steps * lasStep;
        low_[axis] = std::min(low_[axis], stored);
        high_[axis] = std::max(high_[axis], stored);
    }
    const bool isGround = point.blade == trace::LidarReturn::ground;
    put(static_cast<std::uint16_t>(
        std::lround(65535.0 * std::clamp(double(point.intensity), 0.0, 1.0))));
    put(static_cast<std::uint8_t>(point.number | point.returns << 4));
    put(std::uint8_t(0));
    put(isGround ? groundClass : lowVegetation);
    put(isGround ? noSpecies : species_[point.blade]);
    put(std::int16_t(0));
    put(std::uint16_t(0));
    put(double(point.beam));
}

void PointFile::add(std::span<const trace::LidarReturn> points)
{
    bytes_.clear();
    for (const trace::LidarReturn& point : points) {
        ++ofNumber_[point.number - 1u];
        if (format_ == Format::las) {
            addLas(point);
            continue;
        }
        const bool isGround = point.blade == trace::LidarReturn::ground;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            put(point.place[axis]);
        put(static_cast<float>(point.range));
        put(point.intensity);
        put(glm::degrees(point.incidence));
        put(point.number);
        put(point.returns);
        put(isGround ? groundClass : lowVegetation);
        put(isGround ? noSpecies : species_[point.blade]);
        const std::int64_t id =
            isGround ? -1 : static_cast<std::int64_t>(field_.idOf(rootedRow(point.blade)));
        if (format_ == Format::ply) {
            put(double(point.beam));
            put(double(id)); // exact: ids are below 2⁵³
        } else {
            put(point.beam);
            put(id);
        }
    }
    count_ += points.size();
    file_.write(bytes_);
}

void PointFile::commit()
{
    const std::string text = header();
    file_.writeAt(0, std::as_bytes(std::span(text)));
    file_.commit();
}

} // namespace sward::apps
