#include "apps/sward_view/picture/video_encoder.h"

#include "core/error.h"
#include "core/process/program_path.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestSaid = 1000;                 // of ffmpeg's words [bytes]
constexpr std::size_t bytesAtOnce = std::size_t(1) << 18; // between two looks at what it says
constexpr std::chrono::milliseconds endPoll{20};

// Encodes raw pictures in a widely supported format, which needs even sizes.
std::vector<std::string> argumentsFor(const fs::path& part, glm::uvec2 size, double step)
{
    return {VideoEncoder::program().string(),
            "-y",
            "-loglevel",
            "error",
            "-f",
            "rawvideo",
            "-pix_fmt",
            "rgba",
            "-video_size",
            fmt::format("{}x{}", size.x, size.y),
            "-framerate",
            fmt::format("{:.6g}", 1.0 / step),
            "-i",
            "pipe:0",
            "-vf",
            "crop=trunc(iw/2)*2:trunc(ih/2)*2",
            "-pix_fmt",
            "yuv420p",
            part.string()};
}

} // namespace

fs::path VideoEncoder::program()
{
    return programNamed("ffmpeg");
}

VideoEncoder::VideoEncoder(fs::path path, glm::uvec2 size, double step)
    : path_(std::move(path))
    , part_(path_.parent_path() / (path_.stem().string() + ".part" + path_.extension().string()))
    , size_(size)
{
    if (program().empty())
        fail(ErrorKind::unsupported, "{}: ffmpeg is not installed; it encodes films",
             path_.string());
    ffmpeg_ = std::make_unique<ChildProcess>(argumentsFor(part_, size_, step), ChildTalk::takes);
}

VideoEncoder::~VideoEncoder()
{
    ffmpeg_.reset();
    std::error_code ignored;
    fs::remove(part_, ignored);
}

// The beginning of what it says tells the reason.
void VideoEncoder::takeSaid()
{
    said_ += ffmpeg_->said();
    said_.resize(std::min(said_.size(), longestSaid));
}

void VideoEncoder::failAsFfmpegDid()
{
    ffmpeg_->endInput();
    while (!ffmpeg_->endWithin(endPoll))
        takeSaid();
    takeSaid();
    said_.erase(said_.find_last_not_of(" \r\n") + 1);
    fail(ErrorKind::io, "{}: ffmpeg has not written it: {}", path_.string(),
         said_.empty() ? "it ended without a message" : said_);
}

void VideoEncoder::add(const Picture& picture)
{
    if (picture.size != size_)
        fail(ErrorKind::runtime, "{}: a picture of {}x{} pixels in a film of {}x{}", path_.string(),
             picture.size.x, picture.size.y, size_.x, size_.y);
    std::string_view bytes(reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size());
    while (!bytes.empty()) {
        const std::string_view part = bytes.substr(0, bytesAtOnce);
        if (!ffmpeg_->give(part))
            failAsFfmpegDid();
        bytes.remove_prefix(part.size());
        takeSaid();
    }
}

void VideoEncoder::finish()
{
    ffmpeg_->endInput();
    std::optional<ChildProcess::End> end;
    while (!end) {
        end = ffmpeg_->endWithin(endPoll);
        takeSaid();
    }
    std::error_code error;
    if (end->exitCode != 0 || !fs::exists(part_, error))
        failAsFfmpegDid();
    fs::rename(part_, path_, error);
    if (error)
        fail(ErrorKind::io, "{}: {}", path_.string(), error.message());
}

} // namespace sward::view
