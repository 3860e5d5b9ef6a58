#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/uniform_sets.h"
#include "render/field/frame_tables.h"
#include "render/frame/frame_place.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::render {

/// The constants of an instance's frames in flight, which the CPU writes: tables, and for each view
/// its frames, motion and light of the host; and the counts that it reads back.
class InstanceConstants {
public:
    /// The frames of a view.
    enum class Kind : std::uint32_t {
        update,  ///< moves blades for several views; these frames of all views are contiguous
        culling, ///< culls them, and moves those of a single view
        drawing, ///< draws them by the tessellator, in the host's clip space
        raster,  ///< draws them by the rasteriser, in reversed Z
        shadow,  ///< draws the blades near the eye as the sun sees them
        listing, ///< lists every blade; only if `listsAll`
    };

    struct Settings {
        std::uint32_t slots = 1; ///< frames in flight
        std::uint32_t views = 1; ///< at most
        bool listsAll = false;
    };

    InstanceConstants(const gpu::DeviceContext& context, const Settings& settings);

    FramePlace place(std::uint32_t slot, Kind kind, std::uint32_t view) const;
    void put(std::uint32_t slot, Kind kind, std::uint32_t view, const shared::Frame& frame) const;

    /// Sets Eyepoint::lodThreshold in a view's frames, except where all blades are listed.
    void thin(std::uint32_t slot, std::uint32_t view, float lodThreshold) const;

    TablePlace tables(std::uint32_t slot) const;
    VkDeviceAddress motion(std::uint32_t slot, std::uint32_t view) const; ///< shared::Motion
    void putMotion(std::uint32_t slot, std::uint32_t view, const shared::Motion& motion) const;

    /// Returns its address.
    VkDeviceAddress putLight(std::uint32_t slot, std::uint32_t view,
                             const shared::HostLight& light) const;

    /// shared::DrawArguments of the update, then of each view; for transfers and the CPU.
    const gpu::Buffer& counts(std::uint32_t slot) const { return slots_[slot].counts; }

    static VkDeviceSize bytesOf(const Settings& settings);

private:
    struct Slot {
        gpu::Buffer bytes;
        gpu::UniformSets frames;
        gpu::Buffer counts;
    };

    std::uint32_t frameIndex(Kind kind, std::uint32_t view) const;
    VkDeviceSize frameOffset(Kind kind, std::uint32_t view) const;
    VkDeviceSize motionOffset(std::uint32_t view) const;
    template <typename T>
    VkDeviceAddress write(std::uint32_t slot, VkDeviceSize offset, const T& value) const;

    Settings settings_;
    std::vector<Slot> slots_;
};

} // namespace sward::render
