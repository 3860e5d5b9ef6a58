#pragma once

#include "apps/sward_view/fields/field_group.h"
#include "apps/sward_view/headless/stats_json.h"
#include "apps/sward_view/picture/png.h"
#include "apps/sward_view/picture/radiance.h"
#include "apps/sward_view/scene/camera_path.h"
#include "apps/sward_view/scene/frame_options.h"
#include "field/read.h"
#include "gpu/device/device.h"
#include "gpu/device/instance.h"
#include "gpu/memory/image.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace sward::view {

/// Renders fields without a window: draws numbered frames at a fixed step into a picture. Frame 0
/// is at time 0, after the renderer has brought the blades to rest.
class Headless {
public:
    /// What is called for besides counts and times.
    struct Wanted {
        bool blades = false;   ///< blades()
        bool radiance = false; ///< radiance() instead of picture(); the exposure is 1
    };

    /// Reads the fields first, so that a wrong file is also reported on a machine without a device.
    /// Throws as readField(), join(), Device and FieldRenderer do.
    Headless(const FrameOptions& options, Wanted wanted);

    /// Throws Error{usage} if the time of `last`, a frame's number, is beyond render::longestTime.
    static void requireTime(const FrameOptions& options, std::uint64_t last);

    /// Draws `frame`; call with ascending frames.
    void draw(std::uint64_t frame);

    /// Uploads the patches of a streamed field visible in `frame`, limited by the memory.
    void stream(std::uint64_t frame);

    /// Moves the blades to `frame` without drawing.
    void skip(std::uint64_t frame);

    /// The last picture, on film or as radiance.
    Picture picture();
    Radiance radiance();

    /// Reference picture of `frame`: without culling and level of detail, the mean in linear light
    /// of 256 pictures of one frozen state, each shifted by less than a pixel.
    Picture reference(std::uint64_t frame);
    Radiance referenceRadiance(std::uint64_t frame);

    /// Resets the measured times.
    void forgetTimes();

    /// Counts of the last frame, times of all.
    RunStats stats();

    std::vector<render::FieldRenderer::BladeRecord> blades() const;
    bool isStreamed() const { return renderer_.isStreamed(); } ///< not all blades are resident
    const gpu::Instance& instance() const { return instance_; }

private:
    double timeOf(std::uint64_t frame) const;
    void record(const render::FrameSettings& settings, double time, glm::vec2 jitter);

    /// Draws the pictures of a reference, and calls `use` after each.
    void drawReference(std::uint64_t frame, const std::function<void()>& use);

    const FrameOptions& options_;
    std::vector<field::MappedField> files_;
    FieldGroup fields_;
    render::FrameSettings settings_;
    CameraPath camera_;
    gpu::Instance instance_;
    gpu::Device device_;
    std::uint32_t samples_;
    gpu::Image target_;
    render::FieldRenderer renderer_;
    gpu::Timestamps timestamps_;
    gpu::FrameRing ring_;
    std::vector<double> recordTimes_; ///< [ms]
};

} // namespace sward::view
