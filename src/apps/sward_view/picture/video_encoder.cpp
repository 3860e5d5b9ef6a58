#include "apps/sward_view/picture/video_encoder.h"

#include "apps/sward_view/files/child_process.h"
#include "core/error.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>
#include <vector>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

void close(int& file)
{
    if (file >= 0)
        ::close(std::exchange(file, -1));
}

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
    // Use a socket: writing to a closed socket can avoid SIGPIPE.
    std::array<int, 2> in{-1, -1};
    std::array<int, 2> out{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0)
        fail(ErrorKind::runtime, "cannot make a socket: {}", std::strerror(errno));
    pictures_ = in[0];
    try {
        if (::pipe2(out.data(), O_CLOEXEC | O_NONBLOCK) != 0)
            fail(ErrorKind::runtime, "cannot make a pipe: {}", std::strerror(errno));
        said_ = out[0];
        child_ = startChild(argumentsFor(part_, size_, step), out[1], in[1]);
    } catch (...) {
        close(in[1]);
        close(out[1]);
        close(pictures_);
        close(said_);
        throw;
    }
    close(in[1]);
    close(out[1]);
}

VideoEncoder::~VideoEncoder()
{
    if (child_ > 0)
        end(SIGKILL);
    close(said_);
    std::error_code ignored;
    fs::remove(part_, ignored);
}

int VideoEncoder::end(int signal)
{
    close(pictures_);
    if (signal != 0)
        ::kill(child_, signal);
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR)
        continue;
    child_ = -1;
    return status;
}

void VideoEncoder::failAsFfmpegDid()
{
    if (child_ > 0)
        end(0);
    std::array<char, 1000> words{};
    const ssize_t count = ::read(said_, words.data(), words.size());
    std::string said(words.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    said.erase(said.find_last_not_of(" \n") + 1);
    fail(ErrorKind::io, "{}: ffmpeg has not written it: {}", path_.string(),
         said.empty() ? "it ended without a message" : said);
}

void VideoEncoder::add(const Picture& picture)
{
    if (picture.size != size_)
        fail(ErrorKind::runtime, "{}: a picture of {}x{} pixels in a film of {}x{}", path_.string(),
             picture.size.x, picture.size.y, size_.x, size_.y);
    const std::uint8_t* bytes = picture.rgba.data();
    for (std::size_t left = picture.rgba.size(); left > 0;) {
        const ssize_t count = ::send(pictures_, bytes, left, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            failAsFfmpegDid();
        bytes += count;
        left -= static_cast<std::size_t>(count);
    }
}

void VideoEncoder::finish()
{
    const int status = end(0);
    std::error_code error;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !fs::exists(part_, error))
        failAsFfmpegDid();
    fs::rename(part_, path_, error);
    if (error)
        fail(ErrorKind::io, "{}: {}", path_.string(), error.message());
}

} // namespace sward::view
