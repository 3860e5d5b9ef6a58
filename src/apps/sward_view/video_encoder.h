#pragma once

#include "apps/sward_view/png.h"

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace sward::view {

/// A film of pictures, which the program ffmpeg encodes while they come. The file appears when it
/// is finished; of an unfinished one nothing is left.
class VideoEncoder {
public:
    /// Where ffmpeg is: the first of $PATH. Empty if it is not installed.
    static std::filesystem::path program();

    /// Of pictures of `size` pixels, `step` [s] apart; the ending of `path` says in which format.
    /// Throws Error{unsupported} without ffmpeg, Error{runtime} if it cannot be run.
    VideoEncoder(std::filesystem::path path, glm::uvec2 size, double step);
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;
    ~VideoEncoder();

    /// Waits until ffmpeg has taken it in. Throws Error{io} with ffmpeg's own words if it has
    /// ended, Error{runtime} if the picture has another size than the first.
    void add(const Picture& picture);

    /// Waits until the file is there. Throws Error{io}.
    void finish();

    const std::filesystem::path& path() const { return path_; }

private:
    [[noreturn]] void failAsFfmpegDid();
    int end(int signal);

    std::filesystem::path path_;
    std::filesystem::path part_;
    glm::uvec2 size_;
    pid_t child_ = -1;
    int pictures_ = -1; ///< its stdin
    int said_ = -1;     ///< its stderr
};

} // namespace sward::view
