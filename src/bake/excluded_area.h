#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>

namespace sward::bake {

/// Where nothing may grow: wherever the line along ground-up through a root meets a mesh, and
/// wherever the mesh is nearer than a margin.
struct ExcludedArea {
    std::string file;    ///< for messages
    double margin = 0.0; ///< [m]
    std::shared_ptr<const terrain::GroundMesh> mesh = {};
};

/// "FILE", "FILE:M", "FILE:margin M" or "FILE:margin=M". An existing file of the whole name wins.
/// The mesh is left for loadExcluded(). Throws Error{usage}.
ExcludedArea parseExcludedArea(const std::string& text);

/// An excluded area made ready for millions of questions. Thread-safe.
class Exclusion {
public:
    /// `area` must have its mesh and may die afterwards; `origin` is that of the ground.
    Exclusion(const ExcludedArea& area, glm::dvec3 origin);

    /// Whether nothing may grow at `place`, relative to the ground's origin. The line along unit
    /// `groundUp` ends `below` [m] under it; infinite but for radial ground-up, where it ends in
    /// the centre.
    bool holds(glm::dvec3 place, glm::dvec3 groundUp, double below) const;

private:
    terrain::SurfaceQuery query_;
    glm::dvec3 shift_; ///< what leads from the ground's origin to the mesh's
    glm::dvec3 middle_{0.0};
    double radius_ = 0.0; ///< of a ball about the middle that holds the mesh [m]
    double margin_;
};

} // namespace sward::bake
