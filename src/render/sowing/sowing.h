#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/edits/staged_edits.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/frame/frame_stats.h"
#include "render/sowing/device_sower.h"
#include "render/sowing/sow_choice.h"
#include "render/sowing/sow_workers.h"
#include "render/sowing/sown_tables.h"
#include "render/sowing/stored_cells.h"
#include "render/streaming/eye_motion.h"
#include "shaders/shared/eyepoint.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace sward::render {

/// Sows the blades near the eyes into device memory (decision 0045): units that eyes want are grown
/// by the device or on the CPU, a bounded number in each frame. Units that are wanted less make
/// room. Several placed fields may share the blades, each with its own states.
class Sowing {
public:
    struct Settings {
        std::uint32_t framesInFlight = 1;
        std::uint32_t threads = 0; ///< that unpack cells and grow units; 0: choose() does some
        bool waits = false; ///< choose() waits until all that is wanted is there, or no room is left
        std::optional<DeviceSower::Settings> device{}; ///< none: the CPU grows all, as if it waits
    };

    /// The data viewed by `field` must outlive it. `stored`: its stored cells in the tables, if
    /// these are to be edited; else null.
    Sowing(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
           const field::FieldView& field, std::unique_ptr<SownTables> tables,
           std::unique_ptr<StoredCells> stored, const Settings& settings);

    const SownTables& tables() const { return *tables_; }

    /// Chooses arriving and leaving units for the frame recorded next. `seen`: the eyepoints for
    /// culling, at least one, of equal lodThreshold, which is raised to match what is there. Must
    /// be followed by record() for the same slot, whose former commands must have completed. Throws
    /// Error{input} if the field's seeds are damaged.
    void choose(std::span<shared::Eyepoint> seen, std::uint32_t slot);

    /// Records the changes: see StagedEdits::record().
    void record(const gpu::Recording& commands, const BakedBlades& baked,
                std::span<const BladeStates* const> states, std::uint32_t settledAt,
                std::uint32_t slot);

    /// Replaces cells of an edited field, from the next choose() on. What is sown in changed places
    /// is drawn as it was until it has grown again. Throws Error{usage} unless the stored cells were
    /// given, Error{input} for damaged seeds, Error{runtime} without room for stored blades.
    void apply(const field::Delta& delta, const StagedEdits::Cover& cover);

    /// Replaces what bears in cells.
    void replace(std::span<const std::shared_ptr<const field::SeedCell>> cells);

    /// The place of each blade of the stored field; none if these are those of the field.
    std::vector<std::uint32_t> placesOf(const field::FieldView& field) const;
    bool isEditable() const { return stored_ != nullptr; }

    /// Whether further frames would change nothing with a fixed eye.
    bool isSettled() const { return isSettled_; }

    /// Blades in memory, and all that there would be.
    std::uint64_t residentBlades() const;
    std::uint64_t allBlades() const { return allBlades_; }

    /// All units in memory that have blades, in order; the spans are valid until the next choose().
    std::vector<SownTables::Resident> residents() const;
    std::optional<SownTables::Resident> residentOf(const field::SowUnit& unit) const;

    /// Grows a unit again, with keys: its blades are in the order of those in memory.
    field::GrownUnit grownAgain(const field::SowUnit& unit);

    /// Upper bound of the patches with blades that a walk from this eyepoint finds.
    std::uint64_t visiblePatches(const shared::Eyepoint& view) const;

    /// Units in place of pages.
    StreamingStats stats() const;

    VkDeviceSize bytes() const; ///< of mapped memory, and of the device's to sow with

private:
    struct Present {
        SownTables::Place place; ///< of a unit without blades: no places
        float score = 0.0f;
        bool isStale = false; ///< its cell has been replaced, and it has changed
    };
    bool isThere(const field::SowUnit& unit) const; ///< and not stale
    void stage(Edit& edit, const StagedEdits::Cover& cover);
    void dropStale(Edit& edit);
    bool takeResults();
    bool takeBatch(std::uint32_t slot);
    void order();
    bool isKnown(const field::SowUnit& unit) const;
    float replaceable() const;
    std::optional<SownTables::Place> placeFor(const field::UnitPatches& unit, float score,
                                              Edit& edit);
    bool haveMoved() const;
    void bring(std::size_t views);
    void ask();
    void takeIn(Edit& edit);
    bool makeRoom(float score, Edit& edit);
    void findMissing(std::span<const shared::Eyepoint> views);
    void forgetBare();
    SownTables::Resident residentAt(const field::SowUnit&, const SownTables::Place&) const;

    Settings settings_;
    std::unique_ptr<SownTables> tables_;
    std::unique_ptr<StoredCells> stored_;
    SowChoice choice_;
    SowWorkers workers_;
    StagedEdits staged_;
    std::unique_ptr<DeviceSower> device_; ///< if it grows units
    EyeMotion motion_;
    std::vector<SowChoice::Wanted> wanted_;
    std::map<field::SowUnit, Present> present_;
    std::map<field::SowUnit, field::GrownUnit> ready_;    ///< grown, and not in memory yet
    std::map<field::SowUnit, UnitOrder> orders_;          ///< for the device
    std::map<field::SowUnit, bool> growing_;              ///< in batches; whether an edit is newer
    std::map<field::SowUnit, DeviceSower::Grown> landed_; ///< of the batch that has just been done
    std::set<field::SowUnit> refused_;                    ///< the CPU has to grow them
    std::uint64_t allBlades_;
    std::uint64_t copied_ = 0;             ///< bytes, in the last frame
    float nearestMissing_ = 0.0f;          ///< [m]
    float missingScore_ = 0.0f;            ///< the highest of what is missing
    std::size_t missing_ = 0;              ///< wanted units that are not there
    std::vector<shared::Eyepoint> eyes_;   ///< of the views, then of these moved ahead
    std::vector<shared::Eyepoint> looked_; ///< the same of the last choice
    float thinning_ = 0.0f;                ///< 0: before the first frame
    bool isFull_ = false;
    bool hasAsked_ = false; ///< in the last choice
    bool isSettled_ = false;
};

} // namespace sward::render
