#pragma once

#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/sowing/seed_cell_pool.h"
#include "render/sowing/unit_order.h"
#include "shaders/shared/sow/sow_pass.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Grows units of a field's seeds by shaders: the bytes of field::growUnit(). Each frame may record
/// a batch of units; its blades wait in memory of the frame until the same slot comes again, and
/// the CPU has read what patches they are. Then they are copied to places in the field's table.
class DeviceSower {
public:
    struct Settings {
        std::uint32_t framesInFlight = 1;
        std::uint32_t maxCandidates = 0; ///< of a batch that grow
        VkDeviceSize cellBytes = 0;      ///< device memory of unpacked cells
        VkDeviceSize stagingBytes = 0;   ///< mapped memory of a frame

        /// For a field that may sow so many bytes.
        static Settings of(std::uint64_t sownBytes, std::uint32_t framesInFlight);

        std::uint64_t deviceBytes() const; ///< that it will take
    };

    /// The context and the sower must outlive it.
    DeviceSower(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                const field::Sower& sower, const Settings& settings);

    /// A unit that has been grown. Its blades lie in ranges of the batch, patch by patch.
    struct Grown {
        field::UnitPatches unit;
        std::vector<std::uint32_t> firstBlades; ///< of each patch, in the batch
    };

    /// What the batch gave that `slot` recorded; its commands must have completed.
    struct Finished {
        std::vector<Grown> grown;
        std::vector<field::SowUnit> refused; ///< the CPU has to grow them
    };
    Finished finish(std::uint32_t slot);

    /// Begins what record() records for `slot`, after finish().
    void begin(std::uint32_t slot);

    /// Gives the blades of a unit, which finish() has returned in this frame, places from `first`
    /// on.
    void place(const Grown& grown, std::uint32_t first);

    enum class Added { yes, later, never };
    /// Adds a unit to the next batch. later: there is no room in this frame. never: the CPU has to
    /// grow it.
    Added add(const UnitOrder& order);

    /// A cell's content has changed.
    void forgetCell(std::size_t index) { cells_.forget(index); }

    /// Records the copies and the batch, with barriers from and to everything. `times`, if any,
    /// gets a scope of each pass.
    void record(const gpu::Recording& commands, const gpu::Buffer& blades,
                gpu::Timestamps* times = nullptr);

    bool isBusy() const; ///< some batch has not been read yet
    VkDeviceSize bytes() const;

private:
    struct Unit {
        field::SowUnit unit;
        float heightStep = 0.0f; ///< of its blades
    };
    struct Slot {
        gpu::Buffer staging;
        gpu::Buffer blades;  ///< of the last batch
        gpu::Buffer results; ///< counts, words of units, patches; read by the CPU
        std::vector<Unit> units;
    };
    struct Copy {
        VkBuffer to = VK_NULL_HANDLE;
        VkBufferCopy region{};
    };
    void stageFor(const gpu::Buffer& to, VkDeviceSize offset, std::span<const std::byte> bytes);
    void recordBatch(const gpu::Recording& commands, gpu::Timestamps* times);
    void recordPlaces(const gpu::Recording& commands, const gpu::Buffer& blades);
    Grown unpacked(const Unit& of, std::span<const shared::SowPatch> patches) const;

    const field::Sower* sower_;
    Settings settings_;
    gpu::ComputePipeline find_;
    gpu::ComputePipeline scan_;
    gpu::ComputePipeline sort_;
    gpu::ComputePipeline grow_;
    gpu::ComputePipeline lay_;
    gpu::ComputePipeline placing_;
    SeedCellPool cells_;
    gpu::Buffer constants_; ///< meadow, species, tones, ribbons
    gpu::Buffer jobs_;      ///< what a frame's commands read
    gpu::Buffer scratch_;   ///< between the passes
    std::vector<Slot> slots_;

    std::uint64_t batch_ = 0; ///< number
    std::uint32_t slot_ = 0;
    VkDeviceSize staged_ = 0;
    std::vector<Copy> copies_;
    std::vector<shared::SowOrder> orders_;
    std::vector<shared::SowRun> runs_;
    std::vector<shared::SowMove> moves_;
    std::vector<Unit> units_;
    double candidates_ = 0.0;
};

} // namespace sward::render
