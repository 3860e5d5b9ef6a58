#include "picture.h"

#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"

#include <algorithm>
#include <cstdlib>

namespace sward::test {

Picture::Picture(const gpu::DeviceContext& context, glm::uvec2 size, bool isStored, VkFormat format)
    : context_(context)
    , size_(size)
    , image_(context, {.name = "picture",
                       .format = format,
                       .extent = {size.x, size.y},
                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                       .storedAs = isStored ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_UNDEFINED})
{
}

void Picture::draw(render::FieldRenderer& renderer, const render::Camera& camera,
                   const render::FrameSettings& settings, double time, glm::vec2 jitter)
{
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::transition(commands, image_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        renderer.record(commands, {image_.get(), image_.view(), size_, image_.storedView()}, camera,
                        settings, time, 0, nullptr, jitter);
    });
}

void Picture::drawPart(render::FieldRenderer& renderer, const render::Camera& camera,
                       const render::FrameSettings& settings, double time, glm::uvec2 whole,
                       glm::ivec2 first)
{
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::transition(commands, image_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        renderer.record(commands,
                        {.image = image_.get(),
                         .view = image_.view(),
                         .size = size_,
                         .stored = image_.storedView(),
                         .whole = whole,
                         .first = first},
                        camera, settings, time);
    });
}

void Picture::drawLayers(render::FieldRenderer& renderer, const render::Camera& camera,
                         const render::FrameSettings& settings, double time,
                         render::LayerMask layers)
{
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::transition(commands, image_, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
        renderer.record(commands,
                        {.image = image_.get(),
                         .view = image_.view(),
                         .size = size_,
                         .stored = image_.storedView(),
                         .layers = layers},
                        camera, settings, time);
    });
}

std::vector<std::byte> Picture::pixels() const
{
    return gpu::readImage(context_, image_, gpu::ImageUse::colorTarget);
}

std::uint64_t sumOf(const render::FrameStats& stats)
{
    return stats.drawn + stats.lod + stats.culledPatch + stats.culledOrientation +
           stats.culledFrustum + stats.culledDistance + stats.culledOcclusion;
}

std::size_t differingPixels(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < std::min(a.size(), b.size()); i += 4)
        count += std::equal(&a[i], &a[i] + 4, &b[i]) ? 0u : 1u;
    return count;
}

int largestDifference(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    int largest = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest =
            std::max(largest, std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])));
    return largest;
}

} // namespace sward::test
