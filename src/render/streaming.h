#pragma once

#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/copy_ring.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"
#include "render/baked_blades.h"
#include "render/blade_states.h"
#include "render/residency.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/pages.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::render {

/// Blades that lie together in memory.
struct BladePart {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Brings the blades that are seen into device memory, where it does not hold all of a field
/// (decision 0026): a bounded number of pages a frame, by the frame's own commands or by the
/// context's queue for copies.
class Streaming {
public:
    struct Settings {
        std::uint32_t framesInFlight = 1;
        VkDeviceSize frameBytes = 0; ///< that one frame brings at most
        bool waitsForDisk = false;   ///< else what is not in the CPU's memory comes later
    };

    /// What `field` views, `blades` and `states` outlive it; the blades are kept in pages.
    Streaming(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
              const field::FieldView& field, const BakedBlades& blades, const BladeStates& states,
              const Settings& settings);

    /// Decides what comes and what leaves in the frame that is recorded next, in `slot`, whose
    /// former commands have completed. `seen` is the eyepoint by which blades are cullView; its
    /// lodThreshold is changed to what is drawn of what is there.
    void choose(shared::Eyepoint& seen, std::uint32_t slot);

    /// Records it, between barriers from and to everything that touches blades; `time` [s].
    void record(const gpu::Recording& commands, std::uint32_t slot, float time) const noexcept;

    /// Whether nothing would change if the eye stood still.
    bool isSettled() const { return isSettled_; }

    /// How many blades are there in the frame last chosen in `slot`.
    std::uint64_t residentBlades(std::uint32_t slot) const { return frames_[slot].resident; }

    /// Patches of which blades may be there, at most.
    std::uint64_t residentPatches() const { return residency_.patches(); }

    /// Where the blades of a patch are in memory; nothing if they are not.
    std::vector<BladePart> partsOf(const shared::Patch& cell) const;

    /// What the frame's submission waits for, with a queue for copies. It never waits long.
    std::optional<VkSemaphoreSubmitInfo> copied() const;

    /// Device memory, and mapped memory, of these settings, in a field of so many blades.
    static VkDeviceSize bytesFor(const Settings& settings);
    VkDeviceSize bytes() const { return bytesFor(settings_); }

private:
    struct InFlight {
        gpu::Buffer changes;      ///< shared::PageChange
        std::uint32_t count = 0;  ///< of them
        std::uint64_t number = 0; ///< of the frame
        std::uint64_t resident = 0;
    };
    struct Left {
        Residency::Gone gone;
        std::uint64_t frame = 0; ///< in which it left: those before may still read it
    };

    void note(InFlight& frame, const shared::PageChange& change);
    void takeIn(InFlight& frame, std::uint32_t batch);
    void makeRoom(InFlight& frame);
    bool fill(std::uint32_t batch);

    field::FieldView field_;
    const BakedBlades& blades_;
    const BladeStates& states_;
    Settings settings_;
    Residency residency_;
    gpu::CopyRing copies_;
    gpu::ComputePipeline change_;
    std::vector<InFlight> frames_;                   ///< by slot
    std::vector<std::vector<std::uint32_t>> coming_; ///< pages, by batch
    std::vector<Left> left_;                         ///< in the order in which they left
    std::uint64_t frame_ = 0;                        ///< number of the last one
    std::uint64_t done_ = 0;                         ///< up to which they have completed
    float thinning_ = 0.0f;                          ///< 0: no frame yet
    bool isSettled_ = false;
};

} // namespace sward::render
