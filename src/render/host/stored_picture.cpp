#include "core/error.h"
#include "gpu/memory/format_kind.h"
#include "render/host/host_image.h"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>

namespace sward::render {
namespace {

constexpr std::array redFirst{VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB,
                              VK_FORMAT_A8B8G8R8_UNORM_PACK32, VK_FORMAT_A8B8G8R8_SRGB_PACK32};
constexpr std::array blueFirst{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_B8G8R8A8_SRGB};

/// What is told of the image suits the view and the flags.
void requireImage(const StoredPicture& picture)
{
    const VkFormat format = picture.image.format;
    requireStorage(picture.image, "stored picture");
    requireStorage(picture.depthImage, "stored picture, depth");
    requireUsage(picture.depthImage.format == VK_FORMAT_UNDEFINED ||
                     picture.depthImage.format == VK_FORMAT_R32_SFLOAT,
                 "stored picture, depth: its format is {}, not R32_SFLOAT (100)",
                 static_cast<int>(picture.depthImage.format));
    if (format == VK_FORMAT_UNDEFINED)
        return;
    const bool isBlueFirst = std::ranges::find(blueFirst, format) != blueFirst.end();
    const bool isOfBytes = isBlueFirst || std::ranges::find(redFirst, format) != redFirst.end();
    requireUsage(picture.format == VK_FORMAT_R8G8B8A8_UNORM ? isOfBytes : format == picture.format,
                 "stored picture: the image has format {}, which is not stored as format {}",
                 static_cast<int>(format), static_cast<int>(picture.format));
    if (!isOfBytes)
        return;
    requireUsage(isBlueFirst == picture.isBgr,
                 "stored picture: isBgr is {}, and the image's format {} has {} first",
                 picture.isBgr, static_cast<int>(format), isBlueFirst ? "blue" : "red");
    requireUsage(picture.isSrgb || !gpu::isSrgb(format),
                 "stored picture: isSrgb is false, and the image's format {} is sRGB",
                 static_cast<int>(format));
}

} // namespace

void requireValid(const StoredPicture& picture, glm::uvec2 viewSize)
{
    if (picture.color == VK_NULL_HANDLE)
        fail(ErrorKind::usage, "stored picture: it has no colour");
    const bool isOfBytes = picture.format == VK_FORMAT_R8G8B8A8_UNORM;
    if (!isOfBytes && picture.format != VK_FORMAT_R16G16B16A16_SFLOAT)
        fail(ErrorKind::usage, "stored picture: grass is not stored as format {}",
             static_cast<int>(picture.format));
    if (picture.isSrgb && !isOfBytes)
        fail(ErrorKind::usage, "stored picture: halves are linear, not sRGB");
    if (picture.isSrgb && picture.keepsRadiance)
        fail(ErrorKind::usage, "stored picture: radiance has no sRGB encoding");
    requireImage(picture);
    // Subtract: a sum could overflow.
    if (glm::any(glm::lessThan(picture.size, viewSize)) ||
        glm::any(glm::greaterThan(picture.first, picture.size - viewSize)))
        fail(ErrorKind::usage,
             "stored picture: {} x {} pixels do not contain a view of {} x {} at {}, {}",
             picture.size.x, picture.size.y, viewSize.x, viewSize.y, picture.first.x,
             picture.first.y);
}

} // namespace sward::render
