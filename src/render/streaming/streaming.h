#pragma once

#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/copy_ring.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/frame/frame_stats.h"
#include "render/streaming/eye_motion.h"
#include "render/streaming/page_census.h"
#include "render/streaming/page_reader.h"
#include "render/streaming/residency.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/pages.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// A contiguous range of blades in memory.
struct BladePart {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Streams visible blades into device memory if it does not hold the whole field (decision 0026): a
/// bounded number of bytes per frame, by the frame's own commands or by the context's copy queue.
/// Several placed fields may share the blades, each with its own states.
class Streaming {
public:
    struct Settings {
        std::uint32_t framesInFlight = 1;
        VkDeviceSize frameBytes = 0; ///< maximum upload per frame
        bool waitsForDisk = false;   ///< false: blades not in CPU memory are loaded later
        bool usesCopyQueue = true;   ///< if the context has one; else copies are recorded
    };

    /// The data viewed by `field`, and `blades`, must outlive it; `blades` must be paged.
    Streaming(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
              const field::FieldView& field, const BakedBlades& blades, const Settings& settings);

    /// Chooses arriving and leaving pages for the frame recorded next in `slot`, whose former
    /// commands have completed. `seen`: the eyepoints for culling, at least one, of equal
    /// lodThreshold, which is raised to match the resident blades. Must be followed by record().
    void choose(std::span<shared::Eyepoint> seen, std::uint32_t slot);

    /// Records the changes, for the blades and for all `states` with collision state. Needs
    /// barriers from and to all accesses to them; `settledAt`: see
    /// settledTick().
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t settledAt,
                std::span<const BladeStates* const> states) const noexcept;

    /// Whether further frames would change nothing with a fixed eye.
    bool isSettled() const { return isSettled_; }

    /// Number of resident blades in the frame last chosen in `slot`.
    std::uint64_t residentBlades(std::uint32_t slot) const { return frames_[slot].resident; }

    /// Counts of the frame last chosen. Those of wanted and missing pages are of a census, which
    /// takes several calls for a large field.
    StreamingStats stats();

    /// Upper bound of patches with resident blades.
    std::uint64_t residentPatches() const { return residency_.tree().patches(); }

    /// Memory ranges of a patch's blades; empty if they are not resident.
    std::vector<BladePart> partsOf(const shared::Patch& cell) const;

    /// The semaphore wait for the frame's submission, with a copy queue. It is short.
    std::optional<VkSemaphoreSubmitInfo> copied() const;
    /// Device memory and mapped memory for these settings.
    static VkDeviceSize bytesFor(const Settings& settings);
    VkDeviceSize bytes() const { return bytesFor(settings_); }

private:
    struct InFlight {
        gpu::Buffer changes;      ///< shared::PageChange
        std::uint32_t count = 0;  ///< number of changes
        std::uint64_t number = 0; ///< of the frame
        std::uint64_t resident = 0;
    };
    struct Left {
        Residency::Gone gone;
        std::uint64_t frame = 0; ///< in which it left: earlier ones may still read it
    };

    void note(InFlight& frame, const shared::PageChange& change);
    void takeIn(InFlight& frame, std::uint32_t batch);
    void fill(InFlight& frame, std::uint32_t batch);
    void fillWithin(InFlight& frame, std::uint32_t batch, std::uint32_t most);
    bool makeRoom(InFlight& frame, const Residency::Wanted& wanted, std::uint32_t waiting);
    void copy(std::uint32_t batch, std::uint32_t page);

    const BakedBlades& blades_;
    Settings settings_;
    Residency residency_;
    PageCensus census_;
    PageReader reader_;
    std::uint32_t nextPages_ =
        0; ///< that the next frame of a flight may bring, at least a fifth of all
    EyeMotion motion_;
    gpu::CopyRing copies_;
    gpu::ComputePipeline change_;
    std::vector<InFlight> frames_;                   ///< by slot
    std::vector<std::vector<std::uint32_t>> coming_; ///< pages being loaded, by batch
    std::vector<Left> left_;                         ///< in the order of leaving
    std::uint64_t frame_ = 0;                        ///< number of the last frame
    std::uint64_t done_ = 0;                         ///< last completed frame
    float thinning_ = 0.0f;                          ///< 0: before the first frame
    std::uint64_t copied_ = 0;                       ///< bytes, in the last frame
    bool isSettled_ = false;
};

} // namespace sward::render
