#include "store_canvas.h"

#include "core/embedded.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/rendering.h"

#include <glm/gtc/packing.hpp>

#include <array>
#include <cmath>
#include <cstring>

namespace sward::embedded {
std::span<const EmbeddedFile> hostTestShaders();
} // namespace sward::embedded

namespace sward::test {
namespace {

constexpr VkImageUsageFlags storeUsage =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

/// IEC 61966-2-1
float decodedSrgb(float c)
{
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

} // namespace

StoreCanvas::StoreCanvas(const gpu::DeviceContext& context, const Settings& settings)
    : context_(context)
    , settings_(settings)
    , color_(context, {.name = "canvas/color",
                       .format = settings.isSrgb ? VK_FORMAT_R8G8B8A8_SRGB : settings.format,
                       .extent = {settings.size.x, settings.size.y},
                       .usage = storeUsage | (settings.isSrgb ? 0 : VK_IMAGE_USAGE_STORAGE_BIT),
                       .storedAs = settings.isSrgb ? settings.format : VK_FORMAT_UNDEFINED})
    , depth_(context, {.name = "canvas/depth",
                       .format = VK_FORMAT_R32_SFLOAT,
                       .extent = {settings.size.x, settings.size.y},
                       .usage = storeUsage | VK_IMAGE_USAGE_STORAGE_BIT})
{
}

render::StoredPicture StoreCanvas::picture() const
{
    return {.color = settings_.isSrgb ? color_.storedView() : color_.view(),
            .format = settings_.format,
            .isSrgb = settings_.isSrgb,
            .depth = depth_.view(),
            .size = settings_.size};
}

void StoreCanvas::recordScene(VkCommandBuffer commands) const
{
    for (const gpu::Image* image : {&color_, &depth_})
        gpu::transition(commands, *image, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
    {
        const glm::vec4& c = settings_.background;
        const gpu::ColorAttachment targets[]{
            {.view = color_.view(), .clear = std::array{c.x, c.y, c.z, c.w}},
            {.view = depth_.view(), .clear = std::array{depthBefore, 0.0f, 0.0f, 0.0f}}};
        const gpu::RenderingScope scope(commands, color_.extent(), targets);
    }
    for (const gpu::Image* image : {&color_, &depth_})
        gpu::transition(commands, *image, gpu::ImageUse::colorTarget, gpu::ImageUse::storage);
}

void StoreCanvas::recordEnd(VkCommandBuffer commands) const
{
    for (const gpu::Image* image : {&color_, &depth_})
        gpu::transition(commands, *image, gpu::ImageUse::storage, gpu::ImageUse::colorTarget);
}

std::vector<std::byte> StoreCanvas::bytes() const
{
    return gpu::readImage(context_, color_, gpu::ImageUse::colorTarget);
}

std::vector<glm::vec4> StoreCanvas::colors() const
{
    const std::vector<std::byte> read = bytes();
    std::vector<glm::vec4> colors(std::size_t(settings_.size.x) * settings_.size.y);
    if (settings_.format == VK_FORMAT_R16G16B16A16_SFLOAT) {
        for (std::size_t i = 0; i < colors.size(); ++i) {
            glm::uint64 halves = 0;
            std::memcpy(&halves, &read[i * sizeof(halves)], sizeof(halves));
            colors[i] = glm::unpackHalf4x16(halves);
        }
        return colors;
    }
    for (std::size_t i = 0; i < colors.size(); ++i)
        for (glm::length_t c = 0; c < 4; ++c) {
            const float value =
                static_cast<float>(std::to_integer<int>(read[4 * i + std::size_t(c)])) / 255.0f;
            colors[i][c] = settings_.isSrgb && c < 3 ? decodedSrgb(value) : value;
        }
    return colors;
}

std::vector<float> StoreCanvas::depths() const
{
    const std::vector<std::byte> read =
        gpu::readImage(context_, depth_, gpu::ImageUse::colorTarget);
    std::vector<float> depths(read.size() / sizeof(float));
    std::memcpy(depths.data(), read.data(), read.size());
    return depths;
}

namespace {

/// The nearest depth of samples `first` to `end` of each pixel.
std::vector<float> nearestOf(const gpu::DeviceContext& context, const gpu::Image& depth,
                             bool isReversed, std::uint32_t first, std::uint32_t end)
{
    const VkExtent2D extent = depth.extent();
    const gpu::Buffer nearest(
        context, {.name = "nearest",
                  .bytes = VkDeviceSize(extent.width) * extent.height * sizeof(float),
                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    const gpu::Sampler sampler =
        gpu::createSampler(context, {.name = "nearest",
                                     .filter = VK_FILTER_NEAREST,
                                     .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE});
    const gpu::ImageSetLayout layout(
        context, {.name = "nearest", .sampledCount = 1, .stages = VK_SHADER_STAGE_COMPUTE_BIT});
    gpu::ImageSet set(context, layout, "nearest");
    set.setSampled(0, depth.view(), sampler.get());
    const gpu::ShaderLibrary shaders(embedded::hostTestShaders());
    const gpu::ComputePipeline pipeline(context, shaders,
                                        {.name = "nearest",
                                         .shader = "nearest_sample.comp",
                                         .pushConstantBytes = sizeof(VkDeviceAddress),
                                         .setLayouts = {layout.get()},
                                         .constants = {{.id = 0, .value = isReversed ? 0u : 1u},
                                                       {.id = 1, .value = first},
                                                       {.id = 2, .value = end}}});
    gpu::submitAndWait(context, [&](VkCommandBuffer buffer) {
        const gpu::Recording commands(context, buffer);
        gpu::transition(buffer, depth, gpu::ImageUse::depthTarget, gpu::ImageUse::sampled);
        pipeline.bind(commands);
        set.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout());
        pipeline.push(commands, nearest.address());
        vkCmdDispatch(buffer, (extent.width + 7) / 8, (extent.height + 7) / 8, 1);
    });
    return gpu::readBufferAs<float>(context, nearest);
}

} // namespace

std::vector<float> nearestOfFour(const gpu::DeviceContext& context, const gpu::Image& depth,
                                 bool isReversed)
{
    return nearestOf(context, depth, isReversed, 0, 4);
}

std::vector<float> depthsOfSample(const gpu::DeviceContext& context, const gpu::Image& depth,
                                  std::uint32_t sample)
{
    return nearestOf(context, depth, true, sample, sample + 1);
}

} // namespace sward::test
