#pragma once

#include "core/files/atomic_file.h"
#include "field/field.h"
#include "lidar/lidar.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sward::apps {

/// Points as a file has them, and what its header says of them.
struct PointBytes {
    std::vector<std::byte> bytes;
    std::uint64_t count = 0;
    std::array<std::uint64_t, 15> ofNumber{}; ///< points by the number of their return
    glm::dvec3 low{std::numeric_limits<double>::infinity()};   ///< of a .las
    glm::dvec3 high{-std::numeric_limits<double>::infinity()}; ///< likewise
};

/// Points of a range sensor as a file, which appears whole or not at all: .ply (binary), .npy (one
/// record a point), .las (1.4, point format 6, Z up). docs/lidar.md has their columns.
class PointFile {
public:
    /// Throws Error{usage} for another extension, Error{io} as AtomicFile does.
    PointFile(const std::string& path, const field::FieldView& field,
              std::span<const std::uint8_t> species, bool overwrite);

    /// Points as bytes of this file; on any thread. Throws Error{unsupported} if a .las does not
    /// reach a place.
    PointBytes encode(std::span<const lidar::LidarReturn> points) const;

    /// Appends encoded points. Throws Error{io} if the disk rejects them.
    void add(const PointBytes& points);

    /// Writes what is known at the end, and the file appears.
    void commit();

private:
    enum class Format { ply, npy, las };

    std::string header() const;
    std::size_t rootedRow(std::uint32_t blade) const;

    class Row;
    void putLas(Row& row, const lidar::LidarReturn& point, PointBytes& made) const;
    void putPoint(Row& row, const lidar::LidarReturn& point) const;
    std::size_t pointSize() const;

    std::string path_;
    const field::FieldView& field_;
    std::span<const std::uint8_t> species_;
    AtomicFile file_;
    Format format_;
    PointBytes all_; ///< counts and bounds of what has been added
};

/// The slot of the species of each blade.
std::vector<std::uint8_t> speciesOfBlades(const field::FieldView& field);

/// "points.npy: 12 points of 10 pulses, 1.2 kB; 40.0 % of the rays met the ground, 0.0 % nothing":
/// what has become of the pulses. `output`: the file, or nothing that was written.
std::string countsText(const std::string& output, const lidar::LidarCounts& counts);

/// "point.ply", "point.npy" or "point.las": throws Error{usage} for another extension.
void requirePointName(const std::string& path);

} // namespace sward::apps
