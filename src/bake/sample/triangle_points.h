#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace sward::bake {

/// One triangle of the ground, prepared for many points on it.
class TrianglePoints {
public:
    TrianglePoints(const terrain::GroundMesh& ground, std::size_t triangle);

    /// With its face normal, as ground.faceNormal() returns it.
    TrianglePoints(const terrain::GroundMesh& ground, std::size_t triangle, const glm::dvec3& face);

    /// The root at barycentrics (b, c), on the back if the candidate number has `backSide`.
    RootSample at(float b, float c, std::uint32_t candidate) const;

    /// Unit normal at barycentrics (b, c): the interpolated vertex normal, or the face normal where
    /// the vertex normal points to the other side.
    glm::dvec3 normalAt(double b, double c) const;

    glm::dvec3 faceNormal() const { return face_; }

private:
    std::uint32_t triangle_;
    glm::dvec3 corner_, first_, second_; // a corner and its two edges
    glm::dvec3 normal_[3];
    glm::dvec3 face_;
};

/// Candidate positions on a triangle: the area-preserving image of an Owen-scrambled (0,
/// 2)-sequence in base 2. The first 2ᵏ of any k are stratified over the triangle; each is uniform
/// on it over all seeds. (Sobol' 1967; Owen 1995; scrambling by Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 2020; square to triangle by Osada et al., "Shape Distributions", 2002.)
class TriangleSequence {
public:
    /// For the triangle with number `source` in the whole ground.
    TriangleSequence(std::uint64_t seed, std::uint32_t source, bool back);

    /// Barycentrics (b, c) of candidate `index` (without `backSide`).
    glm::vec2 at(std::uint32_t index) const;

private:
    std::uint32_t first_;
    std::uint32_t second_;
};

/// Random number u in [0, 1) that rounds a triangle's expected number of candidates: ⌊λA + u⌋.
/// Uniform for each triangle over all seeds. Stratified over sixteen, four and two consecutive
/// triangles, so that sums over neighbours stay near their expectation.
double roundingShare(std::uint64_t seed, std::uint32_t source, bool back);

} // namespace sward::bake
