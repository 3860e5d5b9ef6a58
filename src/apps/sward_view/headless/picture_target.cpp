#include "apps/sward_view/headless/picture_target.h"

#include <algorithm>
#include <thread>

namespace sward::view {
namespace {

constexpr VkFormat filmFormat = VK_FORMAT_R8G8B8A8_SRGB;
constexpr VkFormat radianceFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr std::uint32_t usualSamples = 4; ///< of a pixel

} // namespace

gpu::ImageSettings targetFor(const gpu::DeviceContext& context, glm::uvec2 size,
                             render::Geometry geometry, bool isRadiance)
{
    gpu::ImageSettings settings{.name = "picture",
                                .format = isRadiance ? radianceFormat : filmFormat,
                                .extent = {size.x, size.y},
                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                .storedAs = isRadiance ? radianceFormat : VK_FORMAT_R8G8B8A8_UNORM};
    if (geometry == render::Geometry::tessellation || !gpu::isSupported(context, settings))
        settings.storedAs = VK_FORMAT_UNDEFINED;
    return settings;
}

render::FieldRendererSettings rendererFor(const FrameOptions& options, VkFormat format,
                                          bool isRadiance)
{
    return {.colorFormat = format,
            .keepsRadiance = isRadiance,
            .samples = options.samples.value_or(usualSamples),
            .framesInFlight = 1,
            .geometry = options.geometry,
            .rastersForCpu = options.rastersForCpu,
            .castsShadows = true,
            .recordCullResults = options.debug == render::DebugMode::reason,
            .deviceBytes = options.gpuMemory,
            .largestTarget = options.size,
            .waitsForDisk = true,
            .sownBytes = options.sownMemory,
            .sowThreads = std::max(std::thread::hardware_concurrency(), 1U)};
}

} // namespace sward::view
