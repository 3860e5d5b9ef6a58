#pragma once

#include "apps/sward_view/files/frame_names.h"
#include "apps/sward_view/picture/png.h"
#include "apps/sward_view/picture/video_encoder.h"
#include "gpu/context/context.h"
#include "gpu/memory/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sward::view {

/// Captures pictures: the next frame, or a numbered sequence.
class Capture {
public:
    void takePicture(std::filesystem::path path) { picture_ = std::move(path); }

    /// Throws Error{usage} if `names` has no number.
    void takeSequence(const std::string& names, std::uint64_t pictures, double step);

    /// The same as a video.
    void takeVideo(std::filesystem::path path, std::uint64_t pictures, double step);

    /// Ends the sequence; a video keeps its pictures so far. Returns a message, or nothing. Throws
    /// Error{io}.
    std::string stopSequence();

    /// Whether the next frame is captured, at full resolution.
    bool wantsFrame() const { return picture_ || sequence_; }
    bool isSequence() const { return sequence_.has_value(); }

    /// Field time per frame of a sequence [s].
    double step() const { return sequence_->step; }

    /// Number of the next picture, from 1; 0: no sequence.
    std::uint64_t at() const { return sequence_ ? sequence_->next + 1 : 0; }

    /// Writes the frame. Returns a message, or nothing. Waits for the device. Throws Error{io};
    /// then the capture ends.
    std::string write(const gpu::DeviceContext& context, const gpu::Image& image);

private:
    struct Sequence {
        std::optional<FrameNames> names; ///< none: a video
        std::filesystem::path videoPath;
        std::uint64_t pictures;
        double step;
        std::uint64_t next = 0;
        std::unique_ptr<VideoEncoder> video; ///< created when the size is known
    };

    void add(const Picture& picture);

    std::optional<std::filesystem::path> picture_;
    std::optional<Sequence> sequence_;
};

/// The pixels of a colour image in ImageUse::transferSource as a picture.
Picture pictureOf(const gpu::DeviceContext& context, const gpu::Image& image);

} // namespace sward::view
