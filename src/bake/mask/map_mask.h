#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/maps/map_shapes.h"

#include <glm/vec3.hpp>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace sward::bake {

/// A band of a map as a factor of the density. read() of the whole ground comes first; parts of it
/// then read nothing, so that other threads may be at().
class MapMask {
public:
    /// `classes`: values that are 1 where all others are 0; empty: the value itself is the factor.
    /// `text`: of the mask, for messages.
    MapMask(std::string file, int band, std::vector<double> classes, std::string text);

    /// Reads what lies under bearing ground, unless that has been read. Throws as
    /// terrain::readMap().
    void read(const terrain::GroundMesh& ground);

    /// Value at a place of the world, 1 or 0 by classes; NaN where the map has no data and beyond
    /// its edge. Values are interpolated bilinearly, classes are those of the nearest sample.
    double at(glm::dvec3 place) const;

private:
    std::string file_;
    int band_;
    std::vector<double> classes_;
    std::string text_;
    terrain::MapGrid grid_;
    terrain::MapBounds read_;
    std::string system_;
    bool isRead_ = false;
    std::mutex mutex_; ///< of read()
};

/// Areas of a map, widened by a margin. read() once, then holds() by any thread.
class MapArea {
public:
    MapArea(std::string file, double margin);

    /// Reads the file in the coordinate system of the ground, unless it has been read. Throws as
    /// terrain::readMapShapes().
    void read(const terrain::GroundMesh& ground);

    /// Of all areas that have been read.
    terrain::MapBounds bounds() const;

    /// Whether a place of the world lies in one of the areas.
    bool holds(glm::dvec3 place) const;

private:
    std::string file_;
    double margin_;
    std::string system_;
    std::shared_ptr<const terrain::MapShapes> shapes_;
    std::mutex mutex_; ///< of read()
};

} // namespace sward::bake
