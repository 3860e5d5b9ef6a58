#pragma once

#include "bake/bake.h"
#include "bake/plan/root_source.h"
#include "bake/settings/settings.h"
#include "bake/settings/stroke.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <vector>

namespace sward::tests {

/// A hard stroke of full strength through these points [m], painted from above.
bake::Stroke hardStroke(bake::StrokeKind kind, const std::vector<glm::dvec3>& points, double radius,
                        double value = 1.0);

/// One stroke of each kind, and strokes across each other, within 12 m of the origin; soft.
bake::Strokes allKinds();

/// The strokes with their points on the ground's nearest vertices, at heights and normals.
bake::Strokes laidOn(const terrain::GroundMesh& ground, bake::Strokes strokes);

/// Whether a position is inside of a stroke or at most `more` [m] beside it, whatever its normal.
bool isInReach(const bake::Stroke& stroke, const glm::dvec3& place, double more = 0.0);
bool isInReach(const bake::Strokes& strokes, const glm::dvec3& place, double more = 0.0);

/// The roots that a bake keeps, with its strokes.
bake::Sampling paintedRoots(const terrain::GroundMesh& ground, const bake::BakeSettings& settings);

/// The whole bake.
bake::BakeResult paintedField(const terrain::GroundMesh& ground, const bake::BakeSettings& settings,
                              int threads = 2);

} // namespace sward::tests
