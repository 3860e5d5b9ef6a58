#pragma once

#include "render/frame/frame_stats.h"
#include "render/frame/placement.h"
#include "render/grass_frame.h"
#include "render/resident/resident_field.h"
#include "render/tessellation/blade_target.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sward::render {

/// A field placed in the host's world, with its own animated blades.
struct FieldInstance {
    std::shared_ptr<const ResidentField> field{}; ///< several instances may share it
    Placement placement{};                        ///< its placement
};

/// Identifies an instance; never reused.
enum class InstanceId : std::uint64_t {};

/// All the grass of a host's world. It moves once per frame and is drawn in any view. Uses one
/// thread at a time and one queue family, submits nothing and never waits. docs/engine.md
/// Every call throws Error{usage} for a wrong number, handle, instance, slot or view, for a field
/// or target of another device, and for a call out of order; then it has done nothing.
class Grass {
public:
    /// Settings that are constant over all frames.
    struct Settings {
        std::uint32_t framesInFlight = 2;      ///< slots: frames recorded before waiting for one
        std::uint32_t maxViews = 4;            ///< per frame
        bool keepsMotion = false;              ///< for motion vectors; 4 bytes per blade
        std::uint32_t maxListed = 0xffffffffu; ///< blades per instance and view, 16 bytes each
        std::optional<bool> rastersForCpu{};   ///< as FieldRendererSettings::rastersForCpu
    };

    Grass(const gpu::DeviceContext& context, const Settings& settings); ///< context must outlive it
    Grass(const Grass&) = delete;
    Grass& operator=(const Grass&) = delete;
    ~Grass(); ///< after the commands of the last frame

    /// Takes effect in the next frame. Throws Error{runtime} if there is not enough memory, and
    /// Error{usage} if a field that is streamed or editable has less frames in flight or is drawn
    /// by another Grass.
    InstanceId add(const FieldInstance& instance);
    void move(InstanceId id, const Placement& placement); ///< from the next frame on
    void remove(InstanceId id); ///< frees its memory when its last frame's slot is reused

    /// Replaces 32 m cells of a field in all its instances, from the next frame on that draws it.
    /// Blades whose key the cell had before keep their state, others appear settled in the wind of
    /// that frame. Copies the delta; neither submits nor waits. Throws, and changes nothing:
    /// Error{usage} unless FieldBudget::isEditable, or if another Grass draws the field;
    /// Error{unsupported} if the field would have too many blades; Error{input} if the delta is
    /// damaged or of a field with another origin. After Error{runtime}, for lack of memory, the
    /// field must not be drawn any more.
    void edit(ResidentField& field, const field::Delta& delta);

    /// Compiles ahead what begin() compiles for frames like this one, with instances of `fields`.
    /// On any thread, beside all other calls. Throws as begin() does. docs/engine.md
    void prepare(const GrassFrame& frame, const PreparedFields& fields) const;

    /// Begins a frame in `slot`, whose former commands have completed: writes the frame's constants
    /// and creates objects on first use. Records nothing. Throws as add() does; after Error{usage}
    /// the frame before is still the last, after Error{runtime} there is none to record.
    void begin(std::uint32_t slot, const GrassFrame& frame);

    /// Moves each blade that any of the frame's views may see, once, after the copies of blades
    /// that are streamed; those of a single view are moved by its recordCull(). Call once after
    /// begin(), outside of a rendering; so with recordCull().
    void recordUpdate(VkCommandBuffer commands);

    /// Lists the visible blades of one view. Call after recordUpdate(), and once the view's depth,
    /// if any, is complete and visible to compute shaders: recordRaster() does not read it again.
    void recordCull(VkCommandBuffer commands, std::uint32_t view);

    /// Rasterises the listed blades by compute shaders, much faster than the tessellator. Call
    /// after recordCull() of the view, outside of a rendering. Hidden blades are not lit. Records
    /// nothing if whyTessellated() has a reason.
    ///
    /// Also writes the view's HostLayers, and stores the blades into its StoredPicture unless
    /// whyNotStored() has a reason.
    /// Waits for all commands before it; all commands after it see the grass.
    void recordRaster(VkCommandBuffer commands, std::uint32_t view);

    /// Why recordDraw() into `target` tessellates the blades of one view; null if it draws the
    /// result of recordRaster().
    const char* whyTessellated(std::uint32_t view, const BladeTarget& target) const;
    const char* whyTessellated(std::uint32_t view) const; ///< into a target of the view's samples

    /// Why recordRaster() does not store the blades of one view, so that recordDraw() is needed;
    /// null if it stores them.
    const char* whyNotStored(std::uint32_t view) const;

    /// The instances of the frame last begun, by the numbers that HostLayers have them by.
    std::vector<InstanceId> layerInstances() const;

    /// Draws the blades inside the host's rendering, with scissor and viewport set: the view's
    /// size, depths from 0 to 1. Draws the result of recordRaster() if target and view have equal
    /// samples, else tessellates. Callable repeatedly after recordCull(). Draws nothing if
    /// recordRaster() has stored the view, unless the target is one of depth alone.
    void recordDraw(VkCommandBuffer commands, std::uint32_t view, const BladeTarget& target) const;

    /// Draws only depth, into a target without colours: for shadow maps.
    void recordDepth(VkCommandBuffer commands, std::uint32_t view, const BladeTarget& target) const;

    /// Blade statistics of a view, over all instances, for the frame last begun in `slot`; after
    /// its commands have completed. `simulated` counts for all views.
    FrameStats stats(std::uint32_t view, std::uint32_t slot) const;

    /// Of the fields of the frame last begun that are streamed, after recordUpdate().
    StreamingStats streamingStats() const;

    const Settings& settings() const; ///< as given to the constructor
    VkDeviceSize deviceBytes() const; ///< excludes the fields themselves

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::render
