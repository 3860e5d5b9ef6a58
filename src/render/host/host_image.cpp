#include "render/host/host_image.h"

#include "core/error.h"
#include "gpu/memory/format_kind.h"

namespace sward::render {
namespace {

void requireUse(const HostImage& image, VkImageUsageFlags use, const char* name,
                std::string_view what)
{
    requireUsage(image.usage == 0 || (image.usage & use) != 0,
                 "{}: its usage {:#x} has no VK_IMAGE_USAGE_{}_BIT", what, image.usage, name);
}

} // namespace

void requireSampledDepth(const HostImage& image, bool isCompared, std::string_view what)
{
    requireUse(image, VK_IMAGE_USAGE_SAMPLED_BIT, "SAMPLED", what);
    const gpu::FormatKind kind = gpu::formatKind(image.format);
    // A host may have copied its depth.
    const bool isCopy = !isCompared && (image.format == VK_FORMAT_R32_SFLOAT ||
                                        image.format == VK_FORMAT_R16_SFLOAT ||
                                        image.format == VK_FORMAT_R16_UNORM);
    requireUsage(kind == gpu::FormatKind::undefined || kind == gpu::FormatKind::depth || isCopy,
                 "{}: its format {} {}, and a depth is needed", what,
                 static_cast<int>(image.format), gpu::describe(kind));
}

void requireStorage(const HostImage& image, std::string_view what)
{
    requireUse(image, VK_IMAGE_USAGE_STORAGE_BIT, "STORAGE", what);
}

} // namespace sward::render
