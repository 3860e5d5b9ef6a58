#pragma once

#include "apps/sward_view/frame_options.h"
#include "apps/sward_view/orbit.h"
#include "apps/sward_view/window.h"
#include "field/field.h"
#include "gpu/device.h"
#include "gpu/frame_ring.h"
#include "gpu/instance.h"
#include "gpu/swapchain.h"
#include "render/field_renderer.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace sward::view {

/// Shows a field in a window: steers the camera, keeps the time, draws with two frames in flight.
class Viewer {
public:
    /// `window`, `field` and `options` outlive it; `name` stands in the title.
    Viewer(Window& window, const field::FieldView& field, const FrameOptions& options,
           std::string name);

    /// Until the window is closed, or for so many seconds. Throws Error{interrupted}.
    void run(double seconds);

    const gpu::Instance& instance() const { return instance_; }

private:
    using Clock = std::chrono::steady_clock;

    void steer(const Input& input);
    void keepTime();
    void watchSettings();
    bool draw();
    void tell(std::uint32_t slot);
    float aspect() const;

    Window& window_;
    const FrameOptions& options_;
    field::FieldView field_;
    std::string name_;
    gpu::Instance instance_;
    gpu::Surface surface_;
    gpu::Device device_;
    gpu::Swapchain swapchain_;
    render::FieldRenderer renderer_;
    gpu::FrameRing ring_;
    render::FrameSettings settings_;
    Orbit orbit_;

    double time_ = 0.0; ///< of the field [s]
    bool paused_ = false;
    Clock::time_point lastTick_;
    Clock::time_point lastTitle_;
    Clock::time_point lastLook_; ///< at the settings file
    std::filesystem::file_time_type settingsWritten_{};
    std::uint64_t frames_ = 0;
    std::uint64_t framesAtTitle_ = 0;
};

} // namespace sward::view
