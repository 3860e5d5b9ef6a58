#pragma once

#include "field/field.h"
#include "render/frame/frame_stats.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bench {

/// A flight in a circle over a field, 3 m above its blades.
class Circle {
public:
    /// `speed` in m/s. The data viewed by `field` must outlive it.
    Circle(const field::FieldView& field, double speed);

    /// The camera at a time [s], not before that of the last call.
    nlohmann::json at(double time);

private:
    glm::dvec3 place(double angle) const;
    double ground(glm::dvec3 place) const;

    field::FieldView field_;
    double speed_;
    glm::dvec3 middle_{0.0};
    double radius_ = 1.0;
    double height_ = 0.0; ///< of the ground, smoothed
};

/// What a flight over a streamed field found in its frames.
class Flight {
public:
    void add(const render::StreamingStats& stats);
    nlohmann::json toJson() const;

private:
    std::uint64_t copied_ = 0;     ///< bytes
    std::uint64_t maxCopied_ = 0; ///< in a frame
    std::vector<std::uint64_t> copiedWhileMissing_;
    double nearestMissing_ = std::numeric_limits<double>::infinity(); ///< [m]
};

} // namespace sward::bench
