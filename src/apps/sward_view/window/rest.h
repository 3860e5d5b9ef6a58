#pragma once

#include "apps/sward_view/picture/at_rest.h"
#include "apps/sward_view/picture/refined_picture.h"
#include "render/frame/camera.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace sward::view {

/// What a picture depends on, by value; but for the field, whose exchange disturbs the rest.
struct Seen {
    render::Camera camera;
    std::string settings; ///< as text
    std::uint32_t debug = 0;
    glm::uvec2 window{0};    ///< [pixels]
    std::uint32_t shift = 0; ///< [pixels] of the fine picture in it
    bool isPaused = false;
    double timeScale = 1.0;

    bool operator==(const Seen&) const = default;
};

/// The window's rest, on a device that draws fine pictures only then.
struct Rest {
    explicit Rest(const gpu::DeviceContext& context)
        : picture(context)
    {
    }

    AtRest state;
    RefinedPicture picture;
    std::optional<Seen> seen;        ///< at the last look
    std::optional<glm::vec2> pickAt; ///< pixel to be picked in the next moving picture
    bool isDisturbed = false;        ///< something else than `seen` has changed
    bool hasBegun = false;           ///< the picture shows this rest
    bool mustShow = false;           ///< the window has to be drawn again
    std::uint64_t moving = 0;        ///< moving pictures drawn in a row
};

} // namespace sward::view
