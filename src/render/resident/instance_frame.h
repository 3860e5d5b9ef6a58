#pragma once

#include "render/frame/camera.h"
#include "render/frame/frame_settings.h"
#include "shaders/shared/frame.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sward::render {

/// A view of a field, in the field's space.
struct InstanceView {
    ViewMatrices seen{};                    ///< of the picture, with reversed Z
    std::optional<ViewMatrices> culled{};   ///< of a frozen camera that culls
    std::optional<glm::mat4> tessellated{}; ///< projection of tessellated blades; unset: `seen`'s
    glm::mat4 clipBefore{1.0f};             ///< projection of the frame before
    std::uint32_t samples = 1;              ///< per pixel
    bool isParallel = false;                ///< it has no distances
    shared::DepthPyramid cullPyramid{};     ///< hides blades from the cull
    shared::DepthPyramid rasterPyramid{};   ///< hides blades from the late pass
    std::optional<glm::dmat4> shadowBox{};  ///< see shadowBoxOf(); unset: no shadows of blades
    std::uint64_t shadowMap = 0;            ///< address of its map
};

/// A frame of one instance of a field, in the field's space.
struct InstanceFrame {
    double time = 0.0;        ///< [s]
    std::uint32_t number = 0; ///< counts frames, for the update rate
    FrameSettings settings{};
    std::vector<shared::Collider> colliders{}; ///< at most shared::maxColliders
    std::vector<InstanceView> views{};

    /// Completes the constants of a view by what neither field nor settings say; returns the
    /// light of the host, if there is any. Unset: there is nothing.
    std::function<std::optional<shared::HostLight>(std::uint32_t view, shared::Frame& frame)>
        complete{};
};

} // namespace sward::render
