#pragma once

#include "core/files/atomic_file.h"
#include "field/field.h"
#include "trace/lidar.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sward::apps {

/// Points of a range sensor as a file, which appears whole or not at all: .ply (binary), .npy (one
/// record a point), .las (1.4, point format 6, Z up). docs/lidar.md has their columns.
class PointFile {
public:
    /// Throws Error{usage} for another extension, Error{io} as AtomicFile does.
    PointFile(const std::string& path, const field::FieldView& field,
              std::span<const std::uint8_t> species, bool overwrite);

    /// Appends points. Throws Error{io} if the disk rejects them; Error{unsupported} if a .las does
    /// not reach a place.
    void add(std::span<const trace::LidarReturn> points);

    /// Writes what is known at the end, and the file appears.
    void commit();

private:
    enum class Format { ply, npy, las };

    std::string header() const;
    std::size_t rootedRow(std::uint32_t blade) const;
    void addLas(const trace::LidarReturn& point);
    template <typename T>
    void put(T value);

    std::string path_;
    const field::FieldView& field_;
    std::span<const std::uint8_t> species_;
    AtomicFile file_;
    Format format_;
    std::vector<std::byte> bytes_;
    std::uint64_t count_ = 0;
    std::array<std::uint64_t, 15> ofNumber_{}; ///< points by the number of their return
    glm::dvec3 low_{std::numeric_limits<double>::infinity()};
    glm::dvec3 high_{-std::numeric_limits<double>::infinity()};
};

/// "point.ply", "point.npy" or "point.las": throws Error{usage} for another extension.
void requirePointName(const std::string& path);

} // namespace sward::apps
