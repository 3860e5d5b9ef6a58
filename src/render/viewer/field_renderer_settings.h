#pragma once

#include "core/embedded.h"
#include "render/frame/geometry.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace sward::render {

/// Settings of a FieldRenderer that are constant over all frames.
struct FieldRendererSettings {
    VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB; ///< of all targets
    /// Targets hold linear radiance times exposure instead of a picture on film: without film curve
    /// and dither, and samples are averaged in radiance. Needs VK_FORMAT_R16G16B16A16_SFLOAT.
    bool keepsRadiance = false;

    std::uint32_t samples = 4;               ///< 1 or 4 per pixel
    std::uint32_t framesInFlight = 1;        ///< frames recorded before waiting for one
    Geometry geometry = Geometry::automatic; ///< how blades are drawn

    /// Whether the rasteriser uses its CPU variant: a thread per blade, no occlusion test between
    /// blades, and tile classification for shading. Reason: on a CPU all SIMD lanes execute every
    /// branch. Unset: on CPU devices only. Pictures differ at most in single samples at edges.
    std::optional<bool> rastersForCpu{};

    /// Whether the rasteriser tests blades of about a dozen pixels for occlusion, too. Unset: not
    /// on CPU devices. Never changes a picture.
    std::optional<bool> testsSmallBlades{};

    /// Whether frames may set FrameSettings::bladeShadows: then `deviceBytes` includes their map.
    bool castsShadows = false;

    bool recordCullResults = false; ///< records cull results for dumpBlades(); 20 bytes per blade

    /// Patches that the rasteriser updates and draws per round, with 16 bytes per blade. 0: as many
    /// as hold an eighth of all blades, or 16 million blades.
    std::uint32_t roundPatches = 0;

    /// Device memory budget [bytes], including pictures up to largestTarget [pixels]; 0: unlimited.
    /// If not all blades fit, the field is streamed (decision 0026): visible blades appear
    /// gradually, and the viewed field data must outlive the renderer.
    std::uint64_t deviceBytes = 0;
    glm::uvec2 largestTarget{1920, 1080}; ///< [pixels] that deviceBytes includes
    bool waitsForDisk = false; ///< false: blades not in CPU memory, or not sown, come later

    /// Device memory [bytes] for the blades that a field with seeds sows near the eye, beside what
    /// is stored (decision 0045); 0: they are not sown. Part of `deviceBytes`, if that is set.
    std::uint64_t sownBytes = std::uint64_t(512) << 20;
    std::uint32_t sowThreads = 1; ///< threads that unpack seeds and grow blades; 0: frames do
    std::optional<bool> sowsOnDevice{}; ///< shaders grow the blades; none: unless it is a CPU

    /// Whether FieldRenderer::apply() may replace cells of the field, which must have keys. Costs a
    /// copy of patches and keys in CPU memory, and room for more blades.
    bool isEditable = false;

    /// Whether targets may ask for the layers of flow. Keeps the states of blades before their last
    /// motion: 4 bytes per blade.
    bool keepsMotion = false;

    /// SPIR-V modules; must outlive the renderer. Empty: the built-in ones.
    std::span<const EmbeddedFile> shaders{};
};

} // namespace sward::render
