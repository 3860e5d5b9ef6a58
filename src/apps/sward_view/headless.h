#pragma once

#include "apps/sward_view/camera_path.h"
#include "apps/sward_view/field_group.h"
#include "apps/sward_view/frame_options.h"
#include "apps/sward_view/png.h"
#include "apps/sward_view/stats_json.h"
#include "field/read.h"
#include "gpu/device.h"
#include "gpu/frame_ring.h"
#include "gpu/image.h"
#include "gpu/instance.h"
#include "gpu/timestamps.h"
#include "render/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace sward::view {

/// Fields on a device without a window: draws numbered frames, a fixed step apart, into a picture.
/// Frame 0 is at time 0; by then the renderer has let the blades come to rest.
class Headless {
public:
    /// Reads the fields first, so that a wrong file is reported on a machine without a device too.
    /// `recordCullResults`: whether blades() will be asked for. Throws what readField(), join(),
    /// Device and FieldRenderer throw.
    Headless(const FrameOptions& options, bool recordCullResults);

    /// Draws `frame`; frames come in ascending order.
    void draw(std::uint64_t frame);

    /// Brings all that `frame` shows of a field that is streamed, as far as it fits.
    void stream(std::uint64_t frame);

    /// Moves the blades to `frame` and draws nothing.
    void skip(std::uint64_t frame);

    /// What was drawn last.
    Picture picture();

    /// `frame` as it would look with all blades and very many samples: without culling and level of
    /// detail, the mean in linear light of 256 pictures of one frozen state, each moved by a part
    /// of a pixel.
    Picture reference(std::uint64_t frame);

    /// Forgets all times measured so far.
    void forgetTimes();

    /// Counts of the last frame, times of all.
    RunStats stats();

    std::vector<render::FieldRenderer::BladeRecord> blades() const;
    bool isStreamed() const { return renderer_.isStreamed(); } ///< not all blades are there
    const gpu::Instance& instance() const { return instance_; }

private:
    double timeOf(std::uint64_t frame) const;
    void record(const render::FrameSettings& settings, double time, glm::vec2 jitter);

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
