#pragma once

#include "terrain/ground_mesh.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

/// Small grounds with properties known by hand. All are valid, with normals, one material "ground"
/// and one node "ground", everything bearing.
namespace sward::meshes {

/// Ground of these corners; its normals come from topology.
terrain::GroundMesh soup(const std::vector<glm::dvec3>& positions,
                         const std::vector<glm::uvec3>& triangles);

/// (0,0,0), (0,0,1), (1,0,0): faces up, area 1/2.
terrain::GroundMesh triangle();

/// Level, faces up, around the origin; two triangles.
terrain::GroundMesh square(double side = 1.0, double height = 0.0);

/// Level, faces up, around the origin; cells × cells squares of two triangles, row by row.
terrain::GroundMesh grid(std::uint32_t cells, double side);

/// Gentle hills of a square of this side around the origin, on a grid of cells × cells.
terrain::GroundMesh hills(double side, std::uint32_t cells);

/// Closed, outward, around the origin; welded corners, so 8 vertices before creases split them.
terrain::GroundMesh cube(double side = 2.0);

/// Two level triangles side by side whose areas are as 1000 to 1: 500 m² (the first) and 0.5 m².
terrain::GroundMesh areaRatioPair();

/// A UV sphere of `segments` and segments/2 rings (even), radial normals.
terrain::GroundMesh sphere(std::uint32_t segments = 64, double radius = 1.0);

/// Three unit squares that share one edge along z: not manifold.
terrain::GroundMesh book();

/// A strip with half a twist: one border, no consistent front.
terrain::GroundMesh moebius(std::uint32_t segments = 32);

/// A level 10 m square at height 0 (the first triangles), and a closed 2 m cube whose lower face is
/// 1 m above its middle.
terrain::GroundMesh boxAbovePlane();

/// `mesh` turned about the world's origin.
terrain::GroundMesh rotated(const terrain::GroundMesh& mesh, const glm::dquat& turn);

/// `mesh` moved in the world.
terrain::GroundMesh moved(const terrain::GroundMesh& mesh, const glm::dvec3& by);

/// Volume inside a closed mesh; positive if its fronts are outside [m³].
double signedVolume(const terrain::GroundMesh& mesh);

/// Sum of all areas [m²].
double totalArea(const terrain::GroundMesh& mesh);

} // namespace sward::meshes
