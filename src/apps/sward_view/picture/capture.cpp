#include "apps/sward_view/picture/capture.h"

#include "core/error.h"
#include "gpu/memory/readback.h"

#include <fmt/core.h>

#include <utility>

namespace sward::view {

void Capture::takeSequence(const std::string& names, std::uint64_t pictures, double step)
{
    FrameNames numbered(names);
    if (!numbered.numbered())
        fail(ErrorKind::usage, "{}: the name has no frame number; write %d or %04d in it", names);
    sequence_.emplace(Sequence{std::move(numbered), {}, pictures, step, 0, nullptr});
}

void Capture::takeVideo(std::filesystem::path path, std::uint64_t pictures, double step)
{
    sequence_.emplace(Sequence{std::nullopt, std::move(path), pictures, step, 0, nullptr});
}

std::string Capture::stopSequence()
{
    if (!sequence_)
        return {};
    const Sequence ended = *std::exchange(sequence_, std::nullopt);
    if (!ended.video)
        return {};
    ended.video->finish();
    return fmt::format("{}: video of {} pictures", ended.videoPath.string(), ended.next);
}

void Capture::add(const Picture& picture)
{
    Sequence& sequence = *sequence_;
    if (sequence.names) {
        writePng(picture, sequence.names->of(sequence.next), true);
    } else {
        if (!sequence.video)
            sequence.video =
                std::make_unique<VideoEncoder>(sequence.videoPath, picture.size, sequence.step);
        sequence.video->add(picture);
    }
    ++sequence.next;
}

std::string Capture::write(const gpu::DeviceContext& context, const gpu::Image& image)
{
    const Picture picture = pictureOf(context, image);
    std::string said;
    if (picture_) {
        const std::filesystem::path path = *std::exchange(picture_, std::nullopt);
        writePng(picture, path, false);
        said = fmt::format("{}: {}x{} pixels", path.string(), picture.size.x, picture.size.y);
    }
    if (!sequence_)
        return said;
    // A full disk ends the sequence, not the window.
    try {
        add(picture);
        if (sequence_->next == sequence_->pictures) {
            const std::string last =
                sequence_->names ? fmt::format("{}: last of {} pictures",
                                               sequence_->names->of(sequence_->next - 1).string(),
                                               sequence_->pictures)
                                 : std::string();
            const std::string video = stopSequence();
            said = video.empty() ? last : video;
        }
    } catch (const Error&) {
        sequence_.reset();
        throw;
    }
    return said;
}

Picture pictureOf(const gpu::DeviceContext& context, const gpu::Image& image)
{
    const std::vector<std::byte> bytes =
        gpu::readImage(context, image, gpu::ImageUse::transferSource);
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    Picture picture{{image.extent().width, image.extent().height}, {first, first + bytes.size()}};
    const bool isBlueFirst =
        image.format() == VK_FORMAT_B8G8R8A8_SRGB || image.format() == VK_FORMAT_B8G8R8A8_UNORM;
    for (std::size_t i = 0; isBlueFirst && i + 3 < picture.rgba.size(); i += 4)
        std::swap(picture.rgba[i], picture.rgba[i + 2]);
    return picture;
}

} // namespace sward::view
