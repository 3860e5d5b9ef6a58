#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace sward::gpu {
struct DeviceContext;
} // namespace sward::gpu

namespace sward::render {

/// The host's render target for blades: its own rendering scope, by dynamic rendering or in a
/// render pass.
struct HostTarget {
    /// Formats of the scope's colour attachments. Blades go into the first, motion into the second
    /// if `writesMotion`: neither holds integers. Others stay unchanged (the device then needs
    /// `independentBlend`). None: only depth, for shadow maps or a depth prepass.
    std::vector<VkFormat> colorFormats{};

    /// Two channels: a point's position in the frame before minus its current one, in widths and
    /// heights of the picture, y downwards. Needs Grass::Settings::keepsMotion.
    bool writesMotion = false;
    VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;  ///< of the scope's depth attachment
    VkFormat stencilFormat = VK_FORMAT_UNDEFINED; ///< of its unused stencil attachment
    std::uint32_t samples = 1;                    ///< 1, 2, 4 or 8
    bool hasReversedZ = true;                     ///< as in the views drawn into it
    bool keepsRadiance = false;                   ///< linear radiance; else tone-mapped
    VkRenderPass renderPass = VK_NULL_HANDLE; ///< or any compatible one; null: dynamic rendering
    std::uint32_t subpass = 0;                ///< of the render pass
};

/// Draws blades into such targets. Copies share what the device holds.
class BladeTarget {
public:
    /// Throws Error{usage} that names a wrong member of `target`; Error{runtime} or
    /// Error{unsupported} if the device cannot create it. Must outlive the
    /// commands that draw with it.
    BladeTarget(const gpu::DeviceContext& context, const HostTarget& target);

    VkDevice device() const { return device_; }              ///< of the context
    const HostTarget& settings() const { return settings_; } ///< as given to the constructor

    struct Parts; ///< its members; private to the library

private:
    friend struct Access;

    VkDevice device_;
    HostTarget settings_;
    std::shared_ptr<const Parts> parts_;
};

} // namespace sward::render
