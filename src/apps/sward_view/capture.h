#pragma once

#include "apps/sward_view/frame_names.h"
#include "apps/sward_view/png.h"
#include "apps/sward_view/video_encoder.h"
#include "gpu/context.h"
#include "gpu/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sward::view {

/// Pictures that are to be written: the next frame, or a numbered sequence.
class Capture {
public:
    void takePicture(std::filesystem::path path) { picture_ = std::move(path); }

    /// Throws Error{usage} if the names have no number in them.
    void takeSequence(const std::string& names, std::uint64_t pictures, double step);

    /// The same as a video.
    void takeVideo(std::filesystem::path path, std::uint64_t pictures, double step);

    /// A film then has the pictures that it has; what there is to tell about it, or nothing. Throws
    /// Error{io}.
    std::string stopSequence();

    /// Whether the frame that comes is wanted, with every pixel of the window.
    bool wantsFrame() const { return picture_ || sequence_; }
    bool isSequence() const { return sequence_.has_value(); }

    /// [s] of the field from frame to frame while a sequence is taken.
    double step() const { return sequence_->step; }

    /// Pictures of the sequence that have been written, and one.
    std::uint64_t at() const { return sequence_ ? sequence_->next + 1 : 0; }

    /// Writes the frame; what there is to tell about it, or nothing. Waits for the device. Throws
    /// Error{io}; then nothing more is wanted.
    std::string write(const gpu::DeviceContext& context, const gpu::Image& image);

private:
    struct Sequence {
        std::optional<FrameNames> names; ///< none: a film
        std::filesystem::path videoPath;
        std::uint64_t pictures;
        double step;
        std::uint64_t next = 0;
        std::unique_ptr<VideoEncoder> video; ///< once its size is known
    };

    void add(const Picture& picture);

    std::optional<std::filesystem::path> picture_;
    std::optional<Sequence> sequence_;
};

/// The pixels of a colour image in ImageUse::transferSource as a picture.
Picture pictureOf(const gpu::DeviceContext& context, const gpu::Image& image);

} // namespace sward::view
