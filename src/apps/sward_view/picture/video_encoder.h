#pragma once

#include "apps/sward_view/picture/png.h"
#include "core/process/child_process.h"

#include <filesystem>
#include <memory>
#include <string>

namespace sward::view {

/// Encodes pictures to a video by the program ffmpeg, while they are drawn. The file appears when
/// it is finished; an unfinished one is deleted.
class VideoEncoder {
public:
    /// Path of ffmpeg: the first in $PATH. Empty if it is not installed.
    static std::filesystem::path program();

    /// Video of pictures of `size` pixels, `step` [s] apart; the extension of `path` sets the
    /// format. Throws Error{unsupported} without ffmpeg, Error{runtime} if it cannot be run.
    VideoEncoder(std::filesystem::path path, glm::uvec2 size, double step);
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;
    ~VideoEncoder();

    /// Writes a picture to ffmpeg and waits. Throws Error{io} with ffmpeg's message if it has
    /// ended, Error{runtime} if the picture's size differs from the first.
    void add(const Picture& picture);

    /// Waits until the file is complete. Throws Error{io}.
    void finish();

    const std::filesystem::path& path() const { return path_; }

private:
    [[noreturn]] void failAsFfmpegDid();
    void takeSaid();

    std::filesystem::path path_;
    std::filesystem::path part_;
    glm::uvec2 size_;
    std::unique_ptr<ChildProcess> ffmpeg_;
    std::string said_; ///< by ffmpeg
};

} // namespace sward::view
