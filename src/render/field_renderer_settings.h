#pragma once

#include "core/embedded.h"
#include "render/geometry.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace sward::render {

/// What stays the same from frame to frame of a FieldRenderer.
struct FieldRendererSettings {
    VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB; ///< of every target
    std::uint32_t samples = 4;                      ///< 1 or 4 per pixel
    std::uint32_t framesInFlight = 1;               ///< frames recorded before one is waited for
    Geometry geometry = Geometry::automatic;        ///< how blades are drawn

    /// Whether the rasteriser does what suits a CPU, whose lanes wait for one another and cannot
    /// jump over what none of them needs: a thread draws each blade, nobody asks which of them
    /// others hide, and tiles of the picture are shaded by what they show. Where nothing is said,
    /// on a CPU device. Changes no picture but for single samples at edges.
    std::optional<bool> rastersForCpu{};

    /// Whether the rasteriser finds out of blades of some dozen pixels that others hide them; where
    /// nothing is said, not on a CPU device. Never changes a picture.
    std::optional<bool> testsSmallBlades{};

    bool recordCullResults =
        false; ///< keep each blade's cull result for dumpBlades(); 20 bytes a blade

    /// The rasteriser updates and draws so many patches at a time, with 16 bytes for each of their
    /// blades; 0: as many as hold an eighth of all blades, or 16 million.
    std::uint32_t roundPatches = 0;

    /// Bytes of device memory for everything, pictures up to largestTarget [pixels] among it;
    /// 0: what it takes. A field of which not all blades fit is streamed (decision 0026): what
    /// is seen comes by and by, and what it views outlives the renderer.
    std::uint64_t deviceBytes = 0;
    glm::uvec2 largestTarget{1920, 1080}; ///< [pixels] that deviceBytes hold room for
    bool waitsForDisk = false;            ///< else what is not in the CPU's memory comes later

    /// SPIR-V modules, which outlive the renderer; empty: those that are built in.
    std::span<const EmbeddedFile> shaders{};
};

} // namespace sward::render
