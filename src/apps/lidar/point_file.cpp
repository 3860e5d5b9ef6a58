#include "apps/lidar/point_file.h"

#include "apps/common/output.h"
#include "apps/common/version.h"
#include "core/error.h"
#include "core/lower_case.h"
#include "shaders/shared/blade.h"

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
constexpr double lasStep = 0.001;          // [m]
constexpr std::size_t plainPointSize = 56; // of .npy and .ply

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

std::vector<std::uint8_t> speciesOfBlades(const field::FieldView& field)
{
    std::vector<std::uint8_t> species(field.blades.size());
    for (const shared::Patch& patch : field.patches)
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i)
            species[i] =
                static_cast<std::uint8_t>(shared::unpackBlade(field.blades[i], patch).species);
    return species;
}

std::string countsText(const std::string& output, const lidar::LidarCounts& counts)
{
    const double rays = std::max(double(counts.rays), 1.0);
    const std::string file =
        output.empty() ? std::string() : ", " + sizeText(std::filesystem::file_size(output));
    return fmt::format("{}{} points of {} pulses{}; {:.1f} % of the rays met the ground, {:.1f} % "
                       "nothing",
                       output.empty() ? "" : output + ": ", counts.returns, counts.beams, file,
                       100.0 * double(counts.groundRays) / rays,
                       100.0 * double(counts.freeRays) / rays);
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
        return plyHeader(all_.count);
    if (format_ == Format::npy)
        return numpyHeader(all_.count);
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
    const glm::dvec3 low = all_.count > 0 ? all_.low : offset,
                     high = all_.count > 0 ? all_.high : offset;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        putAt(header, 131 + 8 * at, lasStep);
        putAt(header, 155 + 8 * at, offset[axis]);
        putAt(header, 179 + 16 * at, high[axis]);
        putAt(header, 187 + 16 * at, low[axis]);
    }
    putAt(header, 247, all_.count);
    for (std::size_t number = 0; number < all_.ofNumber.size(); ++number)
        putAt(header, 255 + 8 * number, all_.ofNumber[number]);
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

// The bytes of a point, one value after another.
class PointFile::Row {
public:
    explicit Row(std::byte* at)
        : at_(at)
    {
    }
    template <typename T>
    void put(T value)
    {
        std::memcpy(at_, &value, sizeof value);
        at_ += sizeof value;
    }

private:
    std::byte* at_;
};

std::size_t PointFile::pointSize() const
{
    return format_ == Format::las ? lasPointSize : plainPointSize;
}

void PointFile::putLas(Row& row, const lidar::LidarReturn& point, PointBytes& made) const
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
        row.put(static_cast<std::int32_t>(steps));
        const double stored = offset[axis] + steps * lasStep;
        made.low[axis] = std::min(made.low[axis], stored);
        made.high[axis] = std::max(made.high[axis], stored);
    }
    const bool isGround = point.blade == lidar::LidarReturn::ground;
    row.put(static_cast<std::uint16_t>(
        std::lround(65535.0 * std::clamp(double(point.intensity), 0.0, 1.0))));
    row.put(static_cast<std::uint8_t>(point.number | point.returns << 4));
    row.put(std::uint8_t(0));
    row.put(isGround ? groundClass : lowVegetation);
    row.put(isGround ? noSpecies : species_[point.blade]);
    row.put(std::int16_t(0));
    row.put(std::uint16_t(0));
    row.put(double(point.beam));
}

void PointFile::putPoint(Row& row, const lidar::LidarReturn& point) const
{
    const bool isGround = point.blade == lidar::LidarReturn::ground;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        row.put(point.place[axis]);
    row.put(static_cast<float>(point.range));
    row.put(point.intensity);
    row.put(glm::degrees(point.incidence));
    row.put(point.number);
    row.put(point.returns);
    row.put(isGround ? groundClass : lowVegetation);
    row.put(isGround ? noSpecies : species_[point.blade]);
    const std::int64_t id =
        isGround ? -1 : static_cast<std::int64_t>(field_.idOf(rootedRow(point.blade)));
    if (format_ == Format::ply) {
        row.put(double(point.beam));
        row.put(double(id)); // exact: ids are below 2⁵³
    } else {
        row.put(point.beam);
        row.put(id);
    }
}

PointBytes PointFile::encode(std::span<const lidar::LidarReturn> points) const
{
    PointBytes made;
    made.count = points.size();
    made.bytes.resize(points.size() * pointSize());
    std::byte* at = made.bytes.data();
    for (const lidar::LidarReturn& point : points) {
        ++made.ofNumber[point.number - 1u];
        Row row(at);
        if (format_ == Format::las)
            putLas(row, point, made);
        else
            putPoint(row, point);
        at += pointSize();
    }
    return made;
}

void PointFile::add(const PointBytes& points)
{
    all_.count += points.count;
    for (std::size_t i = 0; i < all_.ofNumber.size(); ++i)
        all_.ofNumber[i] += points.ofNumber[i];
    all_.low = glm::min(all_.low, points.low);
    all_.high = glm::max(all_.high, points.high);
    file_.write(points.bytes);
}

void PointFile::commit()
{
    const std::string text = header();
    file_.writeAt(0, std::as_bytes(std::span(text)));
    file_.commit();
}

} // namespace sward::apps
