#pragma once

#include "shaders/shared/eyepoint.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Predicts where eyes will be from their places in successive frames.
class EyeMotion {
public:
    /// Frames by which eyes are moved ahead: half a second at 60 frames/s. Counted in frames, since
    /// a frame also bounds what is copied.
    static constexpr float leadFrames = 30.0f;

    /// Takes the eyepoints of the next frame, in the same order in every frame. Returns those that
    /// move, moved ahead. The step of an eye per frame is the shorter of its last two, so that a
    /// single jump predicts nothing; eyes that turn back or are new count as standing.
    std::span<const shared::Eyepoint> ahead(std::span<const shared::Eyepoint> eyes);

private:
    struct Eye {
        glm::vec3 place;
        glm::vec3 step; ///< of the last frame
    };
    std::vector<Eye> eyes_;
    std::vector<shared::Eyepoint> ahead_;
};

} // namespace sward::render
