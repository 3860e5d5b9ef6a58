#include "gpu/memory/format_kind.h"

#include <algorithm>
#include <array>

namespace sward::gpu {
namespace {

// Vulkan numbers a layout's formats in this order: UNORM, SNORM, USCALED, SSCALED, UINT, SINT.
// Those of 32 and 64 bits a channel have the last two alone.
constexpr std::array withScaled{
    VK_FORMAT_R8_UINT,
    VK_FORMAT_R8G8_UINT,
    VK_FORMAT_R8G8B8_UINT,
    VK_FORMAT_B8G8R8_UINT,
    VK_FORMAT_R8G8B8A8_UINT,
    VK_FORMAT_B8G8R8A8_UINT,
    VK_FORMAT_A8B8G8R8_UINT_PACK32,
    VK_FORMAT_A2R10G10B10_UINT_PACK32,
    VK_FORMAT_A2B10G10R10_UINT_PACK32,
    VK_FORMAT_R16_UINT,
    VK_FORMAT_R16G16_UINT,
    VK_FORMAT_R16G16B16_UINT,
    VK_FORMAT_R16G16B16A16_UINT,
};
constexpr std::array withoutScaled{
    VK_FORMAT_R32_UINT,          VK_FORMAT_R32G32_UINT,       VK_FORMAT_R32G32B32_UINT,
    VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R64_UINT,          VK_FORMAT_R64G64_UINT,
    VK_FORMAT_R64G64B64_UINT,    VK_FORMAT_R64G64B64A64_UINT,
};

bool isBetween(VkFormat format, VkFormat first, VkFormat last)
{
    return format >= first && format <= last;
}

bool isOneOf(const auto& firstOnes, int format, int first, int last)
{
    return std::ranges::any_of(
        firstOnes, [&](VkFormat one) { return format >= one + first && format <= one + last; });
}

} // namespace

FormatKind formatKind(VkFormat format)
{
    if (format == VK_FORMAT_UNDEFINED)
        return FormatKind::undefined;
    if (format == VK_FORMAT_S8_UINT)
        return FormatKind::stencil;
    if (isBetween(format, VK_FORMAT_D16_UNORM, VK_FORMAT_D32_SFLOAT_S8_UINT))
        return FormatKind::depth;
    if (isOneOf(withScaled, format, 0, 1) || isOneOf(withoutScaled, format, 0, 1))
        return FormatKind::integer;
    if (isOneOf(withScaled, format, -2, -1))
        return FormatKind::scaled;
    if (isBetween(format, VK_FORMAT_BC1_RGB_UNORM_BLOCK, VK_FORMAT_ASTC_12x12_SRGB_BLOCK) ||
        isBetween(format, VK_FORMAT_PVRTC1_2BPP_UNORM_BLOCK_IMG,
                  VK_FORMAT_PVRTC2_4BPP_SRGB_BLOCK_IMG) ||
        isBetween(format, VK_FORMAT_ASTC_4x4_SFLOAT_BLOCK, VK_FORMAT_ASTC_12x12_SFLOAT_BLOCK))
        return FormatKind::compressed;
    return FormatKind::color;
}

const char* describe(FormatKind kind)
{
    switch (kind) {
    case FormatKind::undefined:
        return "is undefined";
    case FormatKind::color:
        return "is a colour";
    case FormatKind::integer:
        return "holds integers";
    case FormatKind::scaled:
        return "is one of vertices (scaled)";
    case FormatKind::compressed:
        return "is compressed";
    case FormatKind::depth:
        return "is a depth";
    case FormatKind::stencil:
        return "is a stencil";
    }
    return "is not known";
}

bool hasStencil(VkFormat format)
{
    return isBetween(format, VK_FORMAT_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT);
}

bool isSrgb(VkFormat format)
{
    constexpr std::array encoded{VK_FORMAT_R8_SRGB,
                                 VK_FORMAT_R8G8_SRGB,
                                 VK_FORMAT_R8G8B8_SRGB,
                                 VK_FORMAT_B8G8R8_SRGB,
                                 VK_FORMAT_R8G8B8A8_SRGB,
                                 VK_FORMAT_B8G8R8A8_SRGB,
                                 VK_FORMAT_A8B8G8R8_SRGB_PACK32};
    return std::ranges::find(encoded, format) != encoded.end();
}

} // namespace sward::gpu
