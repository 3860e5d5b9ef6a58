#pragma once

#include "core/progress.h"
#include "lidar/lidar.h"
#include "trace/ray_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace sward::trace {

/// Casts all beams and hands their returns, in the order of beams and of range, to `sink`, piece by
/// piece. A ray ends at the first surface: leaves let nothing through. `species`: of each blade of
/// the field. `origin`: the field's. The result is the same for any number of threads. Advances
/// `progress`, whose stage the caller has begun, by a step for each beam. Throws Error{usage} for
/// settings out of range or a direction that is not unit, Error{interrupted} if it is cancelled.
lidar::LidarCounts scan(const RayScene& scene, glm::dvec3 origin,
                        std::span<const std::uint8_t> species, const lidar::Beams& beams,
                        const lidar::LidarSettings& settings, const lidar::ReturnSink& sink,
                        Progress& progress);

} // namespace sward::trace
