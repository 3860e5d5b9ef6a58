#pragma once

#include "gpu/context.h"
#include "render/blade_target.h"
#include "render/frame_settings.h"
#include "render/host_view.h"
#include "render/placement.h"
#include "render/resident_field.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>

namespace sward::render {

/// A field that stands somewhere in the host's world, with blades that move by themselves.
struct FieldInstance {
    std::shared_ptr<const ResidentField> field{}; ///< several instances may share it
    Placement placement{};                        ///< where it stands
};

/// Names an instance for as long as there is one, and never another.
enum class InstanceId : std::uint64_t {};

/// What pushes blades aside: a capsule, or a ball where both ends are one. World space.
struct HostCollider {
    glm::dvec3 from{0.0};     ///< [m]
    glm::dvec3 to{0.0};       ///< [m]
    double radius = 0.5;      ///< [m]
    glm::vec3 velocity{0.0f}; ///< [m/s] at which it has come here
};

/// One frame as the host wants it.
struct GrassFrame {
    double time = 0.0;                 ///< [s], never falling; a step of any length is safe
    std::span<const HostView> views{}; ///< that blades are moved for and may be drawn in

    /// Wind, gravity, sun, sky and level of detail, all in world space. Its colliders are not
    /// looked at, and no air lies between where `fogDensity` is below 0.
    const FrameSettings& settings;
    std::span<const HostCollider> colliders{}; ///< at most shared::maxColliders
};

/// All the grass of a host's world: it moves once in a frame, and is drawn in any view. Uses one
/// thread at a time and one queue family, submits nothing and never waits. docs/engine.md
class Grass {
public:
    /// What stays the same from frame to frame.
    struct Settings {
        std::uint32_t framesInFlight = 2;      ///< slots: frames recorded before one is waited for
        std::uint32_t maxViews = 4;            ///< of a frame
        bool keepsMotion = false;              ///< for motion vectors; 4 bytes a blade
        std::uint32_t maxListed = 0xffffffffu; ///< blades of an instance drawn in a view, 16 bytes
    };

    Grass(const gpu::DeviceContext& context, const Settings& settings); ///< context outlives it
    Grass(const Grass&) = delete;
    Grass& operator=(const Grass&) = delete;
    ~Grass(); ///< after the commands of the last frame

    /// From the next frame on. Throws Error{runtime} where memory does not suffice.
    InstanceId add(const FieldInstance& instance);
    void move(InstanceId id, const Placement& placement); ///< from the next frame on
    void remove(InstanceId id); ///< its memory is freed when its last frame's slot is begun anew

    /// Begins a frame in `slot`, whose former commands have completed: writes what the frame's
    /// commands read, makes what is needed for the first time. Records nothing; throws as add().
    void begin(std::uint32_t slot, const GrassFrame& frame);

    /// Moves the blades that any of the frame's views may see, each once. After begin(), once, and
    /// outside of a rendering, as recordCull().
    void recordUpdate(VkCommandBuffer commands) noexcept;

    /// Lists the blades that one of the frame's views sees, after recordUpdate(), and after the
    /// drawing of the view's depth, if any, has been made visible to compute shaders.
    void recordCull(VkCommandBuffer commands, std::uint32_t view) noexcept;

    /// Rasterises them by compute shaders, after recordCull() of the view, outside of a rendering
    /// and as soon as the view's depth, if any, is complete: what it hides is not lit. Much faster
    /// than the tessellator. Records nothing where whyTessellated() has a reason.
    void recordRaster(VkCommandBuffer commands, std::uint32_t view) noexcept;

    /// Why recordDraw() tessellates the blades of one of the frame's views; null if it draws what
    /// recordRaster() has rasterised.
    const char* whyTessellated(std::uint32_t view) const noexcept;

    /// Draws them, inside the host's rendering, whose viewport, as large as the view and with
    /// depths from 0 to 1, and scissor are set: what recordRaster() has found if the target has as
    /// many samples as the view, else by the tessellator. Any number of times after recordCull().
    void recordDraw(VkCommandBuffer commands, std::uint32_t view,
                    const BladeTarget& target) const noexcept;

    /// Draws no more than their depth: a shadow's map, into a target without colours.
    void recordDepth(VkCommandBuffer commands, std::uint32_t view,
                     const BladeTarget& target) const noexcept;

    /// What became of the blades of a view, of all instances together, in the frame last begun in
    /// `slot`; after its commands have completed. `simulated` counts for all views.
    FrameStats stats(std::uint32_t view, std::uint32_t slot) const;

    VkDeviceSize deviceBytes() const; ///< without the fields themselves

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
