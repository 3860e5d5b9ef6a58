#pragma once

#include "gpu/context.h"
#include "render/frame_settings.h"
#include "render/frame_stats.h"
#include "render/host_view.h"
#include "render/placement.h"
#include "render/resident_field.h"
#include "render/tessellation/blade_target.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>

namespace sward::render {

/// A field placed in the host's world, with its own animated blades.
struct FieldInstance {
    std::shared_ptr<const ResidentField> field{}; ///< several instances may share it
    Placement placement{};                        ///< its placement
};

/// Identifies an instance; never reused.
enum class InstanceId : std::uint64_t {};

/// A capsule that pushes blades aside, or a ball if both ends coincide. World space.
struct HostCollider {
    glm::dvec3 from{0.0};     ///< [m]
    glm::dvec3 to{0.0};       ///< [m]
    double radius = 0.5;      ///< [m]
    glm::vec3 velocity{0.0f}; ///< [m/s] of its movement to here
};

/// Description of one frame by the host.
struct GrassFrame {
    double time = 0.0;                 ///< [s], never decreasing; steps of any length
    std::span<const HostView> views{}; ///< blades are moved for these and drawn in these

    /// Wind, gravity, sun, sky and level of detail, all in world space. Its colliders are ignored,
    /// and there is no fog if `fogDensity` is below 0.
    const FrameSettings& settings;
    std::span<const HostCollider> colliders{}; ///< at most shared::maxColliders
    HostLight light{};                         ///< the host's ambient light and lamps on blades
};

/// All the grass of a host's world. It moves once per frame and is drawn in any view. Uses one
/// thread at a time and one queue family, submits nothing and never waits. docs/engine.md
class Grass {
public:
    /// Settings that are constant over all frames.
    struct Settings {
        std::uint32_t framesInFlight = 2;      ///< slots: frames recorded before waiting for one
        std::uint32_t maxViews = 4;            ///< per frame
        bool keepsMotion = false;              ///< for motion vectors; 4 bytes per blade
        std::uint32_t maxListed = 0xffffffffu; ///< blades per instance and view, 16 bytes each
    };

    Grass(const gpu::DeviceContext& context, const Settings& settings); ///< context must outlive it
    Grass(const Grass&) = delete;
    Grass& operator=(const Grass&) = delete;
    ~Grass(); ///< after the commands of the last frame

    /// Takes effect in the next frame. Throws Error{runtime} if there is not enough memory, and
    /// Error{usage} if a streamed field has less frames in flight or is drawn by another Grass.
    InstanceId add(const FieldInstance& instance);
    void move(InstanceId id, const Placement& placement); ///< from the next frame on
    void remove(InstanceId id); ///< frees its memory when its last frame's slot is reused

    /// Begins a frame in `slot`, whose former commands have completed: writes the frame's constants
    /// and creates objects on first use. Records nothing. Throws as add() does, and Error{usage}
    /// for light out of its ranges (host_light.h); then the frame before is still the last.
    void begin(std::uint32_t slot, const GrassFrame& frame);

    /// Moves each blade that any of the frame's views may see, once, after the copies of blades
    /// that are streamed. Call once after begin(), outside of a rendering; so with recordCull().
    void recordUpdate(VkCommandBuffer commands) noexcept;

    /// Lists the visible blades of one view. Call after recordUpdate(), and after the view's depth,
    /// if any, has been made visible to compute shaders.
    void recordCull(VkCommandBuffer commands, std::uint32_t view) noexcept;

    /// Rasterises the listed blades by compute shaders, much faster than the tessellator. Call
    /// after recordCull() of the view, outside of a rendering, once the view's depth, if any, is
    /// complete: hidden blades are not lit. Records nothing if whyTessellated() has a reason.
    void recordRaster(VkCommandBuffer commands, std::uint32_t view) noexcept;

    /// Why recordDraw() tessellates the blades of one view; null if it draws the result of
    /// recordRaster().
    const char* whyTessellated(std::uint32_t view) const noexcept;

    /// Draws the blades inside the host's rendering, with scissor and viewport set: the view's
    /// size, depths from 0 to 1. Draws the result of recordRaster() if target and view have equal
    /// samples, else tessellates. Callable repeatedly after recordCull().
    void recordDraw(VkCommandBuffer commands, std::uint32_t view,
                    const BladeTarget& target) const noexcept;

    /// Draws only depth, into a target without colours: for shadow maps.
    void recordDepth(VkCommandBuffer commands, std::uint32_t view,
                     const BladeTarget& target) const noexcept;

    /// Blade statistics of a view, over all instances, for the frame last begun in `slot`; after
    /// its commands have completed. `simulated` counts for all views.
    FrameStats stats(std::uint32_t view, std::uint32_t slot) const;

    /// Of the fields of the frame last begun that are streamed, after recordUpdate().
    StreamingStats streamingStats() const;

    VkDeviceSize deviceBytes() const; ///< excludes the fields themselves

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
