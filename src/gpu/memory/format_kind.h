#pragma once

#include <vulkan/vulkan.h>

namespace sward::gpu {

/// What the texels of a format are, for checks that need no device.
enum class FormatKind {
    undefined,  ///< VK_FORMAT_UNDEFINED
    color,      ///< floating-point, normalised or sRGB; also formats of extensions
    integer,    ///< UINT, SINT
    scaled,     ///< USCALED, SSCALED: for vertices
    compressed, ///< in blocks
    depth,      ///< with or without a stencil
    stencil,    ///< a stencil alone
};

FormatKind formatKind(VkFormat format); ///< of the format's texels
const char* describe(FormatKind kind);  ///< "holds integers", "is compressed", …
bool hasStencil(VkFormat format);       ///< beside a depth, or alone
bool isSrgb(VkFormat format);           ///< of bytes without compression

} // namespace sward::gpu
