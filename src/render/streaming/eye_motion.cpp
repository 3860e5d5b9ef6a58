#include "render/streaming/eye_motion.h"

#include <glm/geometric.hpp>

#include <cstddef>

namespace sward::render {
namespace {

/// Shorter steps count as standing [m per frame]: 6 mm/s at 60 frames/s.
constexpr float shortestStep = 1e-4f;

shared::Eyepoint moved(const shared::Eyepoint& eye, glm::vec3 by)
{
    shared::Eyepoint result = eye;
    result.eye += by;
    for (glm::vec4& plane : result.planes)
        plane.w -= glm::dot(glm::vec3(plane), by);
    return result;
}

} // namespace

std::span<const shared::Eyepoint> EyeMotion::ahead(std::span<const shared::Eyepoint> eyes)
{
    ahead_.clear();
    if (eyes_.size() != eyes.size()) {
        eyes_.clear();
        for (const shared::Eyepoint& eye : eyes)
            eyes_.push_back({eye.eye, glm::vec3(0.0f)});
        return ahead_;
    }
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const glm::vec3 before = eyes_[i].step;
        const glm::vec3 step = eyes[i].eye - eyes_[i].place;
        eyes_[i] = {eyes[i].eye, step};
        const float length = glm::length(step);
        if (length < shortestStep || glm::dot(step, before) <= 0.0f)
            continue;
        const float shorter = glm::min(length, glm::length(before));
        if (shorter >= shortestStep)
            ahead_.push_back(moved(eyes[i], step * (leadFrames * shorter / length)));
    }
    return ahead_;
}

} // namespace sward::render
