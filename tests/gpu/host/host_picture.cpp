#include "host_picture.h"

#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/rendering.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace sward::test {
namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat motionFormat = VK_FORMAT_R32G32_SFLOAT;
constexpr double near = 0.1; // [m]
constexpr double far = 200.0;

gpu::Image colorImage(const gpu::DeviceContext& context, VkFormat format, VkExtent2D extent,
                      std::uint32_t samples)
{
    return {context,
            {.name = "host/color",
             .format = format,
             .extent = extent,
             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
             .samples = samples}};
}

VkFormat formatOf(const HostPicture::Settings& settings)
{
    return settings.keepsRadiance ? VK_FORMAT_R32G32B32A32_SFLOAT : colorFormat;
}

render::HostTarget targetOf(const HostPicture::Settings& settings)
{
    render::HostTarget target{.samples = settings.samples, .hasReversedZ = settings.isReversed};
    if (settings.hasColor)
        target.colorFormats = {formatOf(settings)};
    target.keepsRadiance = settings.keepsRadiance;
    target.writesMotion = settings.hasMotion;
    if (settings.hasMotion)
        target.colorFormats.push_back(motionFormat);
    return target;
}

} // namespace

glm::dmat4 perspective(bool isReversed)
{
    const double focal = 2.0;
    const double range = 1.0 / (far - near);
    glm::dmat4 matrix(0.0);
    matrix[0][0] = focal * double(hostSize.y) / double(hostSize.x);
    matrix[1][1] = -focal;
    matrix[2][2] = isReversed ? near * range : -far * range;
    matrix[3][2] = (isReversed ? 1.0 : -1.0) * near * far * range;
    matrix[2][3] = -1.0;
    return matrix;
}

float depthAt(double distance, bool isReversed)
{
    const double reversed = near * (far - distance) / ((far - near) * distance);
    return static_cast<float>(isReversed ? reversed : 1.0 - reversed);
}

render::HostView lookingFrom(glm::dvec3 eye, bool isReversed)
{
    return {.worldToClip = perspective(isReversed) *
                           glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)),
            .size = hostSize,
            .hasReversedZ = isReversed};
}

HostPicture::HostPicture(const gpu::DeviceContext& context, const Settings& settings)
    : context_(context)
    , settings_(settings)
    , extent_{settings.size.x, settings.size.y}
    , color_(colorImage(context, formatOf(settings), extent_, settings.samples))
    , resolved_(colorImage(context, formatOf(settings), extent_, 1))
    , motion_(colorImage(context, motionFormat, extent_, 1))
    , depth_(context, {.name = "host/depth",
                       .format = VK_FORMAT_D32_SFLOAT,
                       .extent = extent_,
                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                       .samples = settings.samples})
    , target_(context, targetOf(settings))
{
}

void HostPicture::recordWall(VkCommandBuffer commands, double distance) const
{
    gpu::transition(commands, depth_, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
    {
        const gpu::DepthAttachment depth{.view = depth_.view(),
                                         .clear = settings_.isReversed ? 0.0f : 1.0f};
        const gpu::RenderingScope scope(commands, extent_, {}, depth);
        VkClearAttachment clear{};
        clear.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
        clear.clearValue.depthStencil.depth = depthAt(distance, settings_.isReversed);
        const VkClearRect left{{{0, 0}, {extent_.width / 2, extent_.height}}, 0, 1};
        vkCmdClearAttachments(commands, 1, &clear, 1, &left);
    }
    gpu::transition(commands, depth_, gpu::ImageUse::depthTarget, gpu::ImageUse::sampled);
}

render::HostDepth HostPicture::depth() const
{
    return {.view = depth_.view(), .samples = settings_.samples};
}

void HostPicture::record(VkCommandBuffer commands, const render::Grass& grass, std::uint32_t view,
                         bool hasWall) const
{
    for (const gpu::Image* image : {&color_, &resolved_, &motion_})
        gpu::transition(commands, *image, gpu::ImageUse::undefined, gpu::ImageUse::colorTarget);
    gpu::transition(commands, depth_, hasWall ? gpu::ImageUse::sampled : gpu::ImageUse::undefined,
                    gpu::ImageUse::depthTarget);
    std::vector<gpu::ColorAttachment> colors;
    if (settings_.hasColor)
        colors.push_back({.view = color_.view(),
                          .resolve = settings_.samples > 1 ? resolved_.view() : VK_NULL_HANDLE,
                          .clear = std::array{0.0f, 0.0f, 0.0f, 0.0f}});
    if (settings_.hasMotion)
        colors.push_back({.view = motion_.view(),
                          .resolve = VK_NULL_HANDLE,
                          .clear = std::array{0.0f, 0.0f, 0.0f, 0.0f}});
    gpu::DepthAttachment depth{.view = depth_.view(), .clear = std::nullopt};
    if (!hasWall)
        depth.clear = settings_.isReversed ? 0.0f : 1.0f;
    const gpu::RenderingScope scope(commands, extent_, colors, depth);
    if (settings_.hasColor)
        grass.recordDraw(commands, view, target_);
    else
        grass.recordDepth(commands, view, target_);
}

std::vector<std::byte> HostPicture::pixels() const
{
    return gpu::readImage(context_, settings_.samples > 1 ? resolved_ : color_,
                          gpu::ImageUse::colorTarget);
}

std::size_t HostPicture::covered() const
{
    const std::vector<std::byte> all = pixels();
    std::size_t count = 0;
    for (std::size_t i = 3; i < all.size(); i += 4)
        count += all[i] != std::byte{0} ? 1u : 0u;
    return count;
}

std::vector<float> HostPicture::depths() const
{
    const std::vector<std::byte> bytes =
        gpu::readImage(context_, depth_, gpu::ImageUse::depthTarget);
    std::vector<float> depths(bytes.size() / sizeof(float));
    std::memcpy(depths.data(), bytes.data(), bytes.size());
    return depths;
}

std::vector<glm::vec4> HostPicture::radiance() const
{
    const std::vector<std::byte> bytes = pixels();
    std::vector<glm::vec4> radiance(bytes.size() / sizeof(glm::vec4));
    std::memcpy(radiance.data(), bytes.data(), bytes.size());
    return radiance;
}

std::vector<glm::vec2> HostPicture::motion() const
{
    const std::vector<std::byte> bytes =
        gpu::readImage(context_, motion_, gpu::ImageUse::colorTarget);
    std::vector<glm::vec2> motion(bytes.size() / sizeof(glm::vec2));
    std::memcpy(motion.data(), bytes.data(), bytes.size());
    return motion;
}

std::size_t pixelsApart(const std::vector<std::byte>& a, const std::vector<std::byte>& b, int most)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < std::min(a.size(), b.size()); i += 4) {
        int apart = 0;
        for (std::size_t c = i; c < i + 4; ++c)
            apart =
                std::max(apart, std::abs(std::to_integer<int>(a[c]) - std::to_integer<int>(b[c])));
        count += apart > most ? 1u : 0u;
    }
    return count;
}

std::shared_ptr<render::ResidentField> GrassTest::upload(const field::Field& made)
{
    auto resident = std::make_shared<render::ResidentField>(context(), field::viewOf(made));
    gpu::submitAndWait(context(),
                       [&](VkCommandBuffer commands) { resident->recordUpload(commands); });
    resident->releaseStaging();
    return resident;
}

void GrassTest::drawFrame(render::Grass& grass, double time,
                          std::span<const render::HostView> views,
                          std::span<const HostPicture* const> pictures,
                          std::span<const render::HostCollider> colliders,
                          std::optional<double> wall) const
{
    grass.begin(0, {.time = time,
                    .views = views,
                    .settings = settings_,
                    .colliders = colliders,
                    .light = light_});
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
        grass.recordUpdate(commands);
        for (std::uint32_t view = 0; view < pictures.size(); ++view) {
            const bool hasWall = wall && view == 0;
            if (hasWall)
                pictures[view]->recordWall(commands, *wall);
            grass.recordCull(commands, view);
            if (rasters_)
                grass.recordRaster(commands, view);
            pictures[view]->record(commands, grass, view, hasWall);
        }
    });
}

std::vector<std::byte> GrassTest::drawnAlone(render::Grass& grass, double time,
                                             const render::HostView& view) const
{
    const HostPicture picture(context(), {.size = view.size, .isReversed = view.hasReversedZ});
    const HostPicture* const pictures[]{&picture};
    drawFrame(grass, time, {&view, 1}, pictures);
    return picture.pixels();
}

} // namespace sward::test
