#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>

namespace sward::bake {

class MapArea;

/// Area without grass: roots whose line along ground-up hits the mesh, and roots nearer to the mesh
/// than a margin.
struct ExcludedArea {
    std::string file;    ///< for messages
    double margin = 0.0; ///< [m]
    std::shared_ptr<const terrain::GroundMesh> mesh = {};
    std::shared_ptr<MapArea> map = {}; ///< instead of a mesh: areas of a map
};

/// Whether the area's file holds shapes of a map; then makes its MapArea, and it has no mesh.
bool takeMapArea(ExcludedArea& area);

/// Parses "FILE", "FILE:M", "FILE:margin M" or "FILE:margin=M". An existing file of the whole name
/// has precedence. loadExcluded() reads the mesh later. Throws Error{usage}.
ExcludedArea parseExcludedArea(const std::string& text);

/// An excluded area prepared for millions of queries. Thread-safe.
class Exclusion {
public:
    /// `area` must have its mesh, or its map, and need not outlive this; `origin` is that of the
    /// ground.
    Exclusion(const ExcludedArea& area, glm::dvec3 origin);

    /// Whether `place`, relative to the ground's origin, is excluded. The line along unit
    /// `groundUp` ends `below` [m] under it: infinite, or the distance to the centre for radial
    /// ground-up.
    bool holds(glm::dvec3 place, glm::dvec3 groundUp, double below) const;

private:
    std::shared_ptr<MapArea> map_;
    glm::dvec3 origin_;
    std::optional<terrain::SurfaceQuery> query_;
    glm::dvec3 shift_{0.0}; ///< offset from the ground's origin to the mesh's
    glm::dvec3 middle_{0.0};
    double radius_ = 0.0; ///< of the mesh's bounding sphere [m]
    double margin_;
};

} // namespace sward::bake
