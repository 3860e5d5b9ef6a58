#pragma once

#include "gpu/handle.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::view {

/// What the user has done since the last question.
struct Input {
    glm::vec2 rotate{0.0f}; ///< drag with the left button [pixels]
    glm::vec2 pan{0.0f};    ///< drag with the middle button, or left with shift [pixels]
    float wheel = 0.0f;     ///< steps; away from the user is positive
    bool frame = false;     ///< F
    bool home = false;      ///< Home
    bool pause = false;     ///< Space
};

/// A window that Vulkan draws into. One at a time; all calls from the thread of main().
class Window {
public:
    /// Hidden until show(). Throws Error{runtime} if there is no display.
    Window(glm::uvec2 size, const std::string& title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// Instance extensions without which there is no surface.
    std::vector<std::string> instanceExtensions() const;

    gpu::Surface createSurface(VkInstance instance) const;

    void show();

    /// Whether the user has closed the window (its button, or Escape).
    bool isClosed() const;

    /// Size of the drawable area [pixels]; 0 while there is nothing to draw into.
    glm::uvec2 drawableSize() const;

    /// Takes in what has happened, without waiting.
    void poll();

    /// Sleeps until something happens, at most so many seconds.
    void waitForEvents(double seconds);

    Input takeInput();
    void setTitle(const std::string& title);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::view
