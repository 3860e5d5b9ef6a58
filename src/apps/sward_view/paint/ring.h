#pragma once

#include "apps/sward_view/paint/stroke.h"
#include "presentation/ground_surface.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace sward::view {

/// Points of a circle of `radius` [m] around `centre`, laid on the ground along its normal; the
/// first is the last, too. World [m]. Where no ground is within the radius they stay in the plane.
std::vector<glm::dvec3> ringOn(const presentation::GroundSurface& ground, const PaintPoint& centre,
                               double radius);

/// Points of a straight stroke of this radius [m] from one place on the ground to another: a
/// quarter of the radius apart, on the ground between them. Where there is none, points are left
/// out.
std::vector<PaintPoint> straightOn(const presentation::GroundSurface& ground,
                                   const PaintPoint& from, const PaintPoint& to, double radius);

/// Lines that show a stroke on the ground: along it, and a ring at each end. World [m].
std::vector<std::vector<glm::dvec3>> outlineOf(const presentation::GroundSurface& ground,
                                               const StrokeSketch& stroke);

/// The ground that a ray from `eye` (world) meets first, as a point of a stroke of this radius [m]:
/// its normal is the mean of what lies within, so that a rough spot does not turn the brush.
std::optional<PaintPoint> paintPointAt(const presentation::GroundSurface& ground,
                                       const glm::dvec3& eye, const glm::dvec3& direction,
                                       double radius);

} // namespace sward::view
