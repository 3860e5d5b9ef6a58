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
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "render/layers/frame_layers.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sward::view {

/// Renders fields without a window: draws numbered frames at a fixed step into a picture. Frame 0
/// is at time 0, after the renderer has brought the blades to rest.
class Headless {
public:
    /// What is called for besides counts and times.
    struct Wanted {
        bool blades = false;          ///< blades()
        bool radiance = false;        ///< radiance() instead of picture(); the exposure is 1
        render::LayerMask layers = 0; ///< that draw() may write
    };

    /// Reads the fields first, so that a wrong file is also reported on a machine without a device.
    /// Throws as readField(), join(), Device and FieldRenderer do.
    Headless(const FrameOptions& options, Wanted wanted);

    /// Throws Error{usage} if the time of `last`, a frame's number, is beyond render::longestTime.
    static void requireTime(const FrameOptions& options, std::uint64_t last);

    /// Draws `frame`; call with ascending frames. `layers` are written, too.
    void draw(std::uint64_t frame, render::LayerMask layers = 0);

    /// Uploads the patches of a streamed field visible in `frame`, limited by the memory.
    void stream(std::uint64_t frame);

    /// A frame by itself.
    struct Shot {
        render::Camera camera;
        render::Camera before; ///< of the frame before, for flow
        render::FrameSettings settings;
        double time = 0.0; ///< [s]
    };

    /// Draws a frame that is no frame of the path. `layers` are written, too.
    void draw(const Shot& shot, render::LayerMask layers);

    /// Moves the blades to `time` [s] under these settings without drawing.
    void move(const render::FrameSettings& settings, double time);

    /// See render::FieldRenderer::forgetMotion().
    void forgetMotion() { renderer_.forgetMotion(); }

    const field::FieldView& field() const { return fields_.view(); }    ///< what is drawn
    const render::FrameSettings& settings() const { return settings_; } ///< of all frames

    /// Time of the device for what was drawn and moved since the last call [ms].
    double takeDeviceTime();

    /// Name and driver of the device.
    std::string deviceName() const;

    /// Moves the blades to `frame` without drawing.
    void skip(std::uint64_t frame);

    /// The last picture, on film or as radiance.
    Picture picture();
    Radiance radiance();

    /// The layers of the last picture that draw() has written. Layer::flowForward is that of the
    /// picture before.
    render::LayerWords layerWords() const;

    /// The same as arrays; on any thread.
    render::FrameLayers layersOf(const render::LayerWords& words) const;

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
    Shot shotAt(double time) const;
    void record(const Shot& shot, glm::vec2 jitter, render::LayerMask layers = 0);

    /// Draws the pictures of a reference, and calls `use` after each.
    void drawReference(std::uint64_t frame, const std::function<void()>& use);

    const FrameOptions& options_;
    std::vector<field::MappedField> files_;
    FieldGroup fields_;
    std::vector<std::uint32_t> numberOfPatch_; ///< number of the field of each patch; empty: one
    render::FrameSettings settings_;
    CameraPath camera_;
    gpu::Instance instance_;
    gpu::Device device_;
    std::uint32_t samples_;
    gpu::Image target_;
    gpu::Buffer staging_; ///< through which pictures are read
    render::FieldRenderer renderer_;
    gpu::Timestamps timestamps_;
    gpu::FrameRing ring_;
    std::vector<double> recordTimes_; ///< [ms]
};

} // namespace sward::view
