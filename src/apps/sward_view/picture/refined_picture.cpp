#include "apps/sward_view/picture/refined_picture.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

namespace sward::view {
namespace {

// The picture's filter reaches one pixel beyond a pixel.
constexpr std::uint32_t margin = 1;

// Edge of a tile [pixels], a multiple of the tiles that the rasteriser sorts. Each tile has a fixed
// cost, of up to 30 ms of a processor, so that shorter ones would waste most of the time.
constexpr std::uint32_t edgeStep = 16;
constexpr std::uint32_t minEdge = 128;
constexpr std::uint32_t maxEdge = 512;

// Wanted time of the longest tile [s]: input is answered within a tenth of a second.
constexpr double wantedOfTile = 0.08;

constexpr std::uint32_t samplesOfMean = 16;

VkImageSubresourceLayers colorLayers()
{
    return {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
}

VkBufferImageCopy copyOf(glm::uvec2 first, glm::uvec2 size)
{
    VkBufferImageCopy region{};
    region.imageSubresource = colorLayers();
    region.imageOffset = {static_cast<std::int32_t>(first.x), static_cast<std::int32_t>(first.y),
                          0};
    region.imageExtent = {size.x, size.y, 1};
    return region;
}

} // namespace

std::uint32_t nextTileEdge(std::uint32_t edge, double seconds)
{
    // Assume time proportional to pixels, and change only by what is worth new images.
    const double share = std::clamp(std::sqrt(wantedOfTile / std::max(seconds, 1e-4)), 0.5, 2.0);
    if (share > 0.8 && share < 1.25)
        return edge;
    const auto wanted = static_cast<std::uint32_t>(static_cast<double>(edge) * share);
    return std::clamp(wanted / edgeStep * edgeStep, minEdge, maxEdge);
}

render::FrameSettings refinedSettings(render::FrameSettings settings, std::uint32_t samples)
{
    settings.minPixels *=
        std::sqrt(static_cast<float>(samples) / static_cast<float>(samplesOfMean));
    // All blades move to the time at which it stands still.
    settings.updateRate = {.everyFrame = 1e9f, .everyThird = 1e9f};
    return settings;
}

void RefinedPicture::begin(const ScaledPicture& coarse, VkExtent2D window, std::uint32_t shift)
{
    const gpu::Image& from = coarse.image();
    const bool isOther = image_.extent().width != window.width ||
                         image_.extent().height != window.height ||
                         image_.format() != from.format();
    if (isOther) {
        gpu::check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
        const gpu::ImageSettings settings{.name = "refined",
                                          .format = from.format(),
                                          .extent = window,
                                          .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                   VK_IMAGE_USAGE_TRANSFER_DST_BIT};
        image_ = gpu::Image(context_, settings);
        next_ = gpu::Image(context_, settings);
    }
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::transition(commands, image_, gpu::ImageUse::undefined, gpu::ImageUse::transferTarget);
        coarse.scaleInto(commands, image_.get(), window);
        gpu::transition(commands, image_, gpu::ImageUse::transferTarget,
                        gpu::ImageUse::transferSource);
        gpu::transition(commands, next_, gpu::ImageUse::undefined, gpu::ImageUse::transferSource);
    });
    shift_ = shift;
    mean_.emplace(glm::uvec2(window.width, window.height));
    pass_ = 0;
    drawnBlades_ = fieldBlades_ = 0;
    beginPass();
}

void RefinedPicture::beginPass()
{
    const VkExtent2D extent{edge_, edge_};
    if (tile_.extent().width != edge_ || tile_.format() != image_.format()) {
        gpu::check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
        tile_ = gpu::Image(context_, {.name = "refined/tile",
                                      .format = image_.format(),
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                               VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                               VK_IMAGE_USAGE_TRANSFER_DST_BIT});
        staging_ = gpu::Buffer(
            context_, {.name = "refined/staging",
                       .bytes = VkDeviceSize(4) * edge_ * edge_,
                       .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                       .memory = gpu::MemoryUse::readback});
    }
    tiles_.clear();
    const std::uint32_t step = edge_ - 2 * margin;
    for (glm::uvec2 first(0); first.y < mean_->size().y; first.y += step)
        for (first.x = 0; first.x < mean_->size().x; first.x += step)
            tiles_.push_back(first);
    const glm::vec2 middle = 0.5f * glm::vec2(mean_->size()) - 0.5f * static_cast<float>(step);
    std::stable_sort(tiles_.begin(), tiles_.end(), [middle](glm::uvec2 a, glm::uvec2 b) {
        return glm::distance(glm::vec2(a), middle) < glm::distance(glm::vec2(b), middle);
    });
    drawnTiles_ = 0;
    longest_ = 0.0;
}

RefinedPicture::Progress RefinedPicture::drawTile(gpu::FrameRing& ring, const Scene& scene)
{
    expect(mean_.has_value(), "the refined picture has begun");
    const auto begun = std::chrono::steady_clock::now();
    const glm::uvec2 first = tiles_[drawnTiles_];
    const glm::uvec2 size = glm::min(glm::uvec2(edge_ - 2 * margin), mean_->size() - first);
    mean_->add(drawPart(ring, scene, first, size), first);

    // Each further picture changes the mean less: show every doubling.
    const std::uint32_t pictures = pass_ + 1;
    const bool isKept = std::has_single_bit(pictures);
    if (isKept)
        keep(mean_->mean(pictures, first, size), first);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    longest_ = std::max(longest_, took.count());

    if (++drawnTiles_ < tiles_.size())
        return {false, false};
    ++pass_;
    if (isKept)
        std::swap(image_, next_);
    edge_ = nextTileEdge(edge_, longest_);
    beginPass();
    return {isKept, true};
}

Picture RefinedPicture::drawPart(gpu::FrameRing& ring, const Scene& scene, glm::uvec2 first,
                                 glm::uvec2 size)
{
    const gpu::FrameRing::Frame frame = ring.begin();
    gpu::transition(frame.commands, tile_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
    scene.renderer.record(frame.commands,
                          {.image = tile_.get(),
                           .view = tile_.view(),
                           .size = glm::uvec2(edge_),
                           .whole = mean_->size(),
                           .first = glm::ivec2(first) - static_cast<int>(margin) +
                                    glm::ivec2(static_cast<int>(shift_), 0)},
                          scene.camera, scene.settings, scene.time, frame.slot, nullptr,
                          subpixelOffset(pass_));
    gpu::transition(frame.commands, tile_, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::transferSource);
    const VkBufferImageCopy region = copyOf(glm::uvec2(margin), size);
    vkCmdCopyImageToBuffer(frame.commands, tile_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           staging_.get(), 1, &region);
    gpu::anythingToHost(frame.commands);
    ring.submit(frame);
    ring.finish();
    const render::FrameStats stats = scene.renderer.stats(frame.slot);
    fieldBlades_ = stats.total;
    if (pass_ == 0)
        drawnBlades_ += stats.drawn;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(staging_.mapped().data());
    return {size, {bytes, bytes + std::size_t(4) * size.x * size.y}};
}

void RefinedPicture::keep(const Picture& part, glm::uvec2 first)
{
    std::memcpy(staging_.mapped().data(), part.rgba.data(), part.rgba.size());
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::transition(commands, next_, gpu::ImageUse::transferSource,
                        gpu::ImageUse::transferTarget);
        const VkBufferImageCopy region = copyOf(first, part.size);
        vkCmdCopyBufferToImage(commands, staging_.get(), next_.get(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        gpu::transition(commands, next_, gpu::ImageUse::transferTarget,
                        gpu::ImageUse::transferSource);
    });
}

} // namespace sward::view
