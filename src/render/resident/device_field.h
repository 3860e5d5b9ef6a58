#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer_upload.h"
#include "gpu/pipeline/shader_library.h"
#include "render/edits/resident_edits.h"
#include "render/field/baked_blades.h"
#include "render/field/field_looks.h"
#include "render/field/grass_cover.h"
#include "render/frame/frame.h"
#include "render/resident/visible_patch_bound.h"
#include "render/sowing/sowing.h"
#include "render/sowing/sown_tables.h"
#include "render/streaming/streaming.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace sward::render {

/// A field in device memory: what all its instances share.
struct DeviceField {
    struct Settings {
        std::uint32_t walkStart = 0;           ///< nodes that a walk begins with, at most
        std::uint32_t pages = 0;               ///< of blades in memory; 0: all blades are resident
        Streaming::Settings streaming{};       ///< of these pages
        std::unique_ptr<EditedField> edited{}; ///< tables of a field that is to be edited, or null
        std::unique_ptr<SownTables> sown{};    ///< tables of a field that is sown, or null
        std::unique_ptr<StoredCells> stored{}; ///< their stored cells, if they are edited
        Sowing::Settings sowing{};             ///< of these tables
        std::uint32_t framesInFlight = 1;      ///< of its edits
        float exposure = 1.0f;                 ///< see FieldShape
        bool boundsRounds = false;             ///< makes `bound`
    };

    /// Begins the upload; it is complete when `upload` is. `made`: of the same field and upload.
    /// The context must outlive it; with pages or seeds to sow
    /// also what `field` views. Throws Error{runtime} for
    /// lack of memory.
    DeviceField(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                gpu::BufferUpload& upload, const field::FieldView& field, GrassCover made,
                Settings settings);
    DeviceField(const DeviceField&) = delete; // the edits keep its members' addresses
    DeviceField& operator=(const DeviceField&) = delete;

    /// Whether apply() may be called.
    bool isEditable() const { return edits != nullptr || (sowing && sowing->isEditable()); }

    /// Replaces cells of an editable field, from the next ResidentEdits::begin() on; of a sown one,
    /// from the next Sowing::record() on.
    void apply(const field::Delta& delta);

    /// Bytes of device memory, and of the mapped memory of streaming and edits.
    VkDeviceSize bytes() const;

    GrassCover cover;
    BakedBlades blades;
    FieldShape shape;
    FieldLooks looks;
    std::optional<VisiblePatchBound> bound;
    std::unique_ptr<Streaming> streaming; ///< if not all blades are resident
    std::unique_ptr<ResidentEdits> edits; ///< if it is editable
    std::unique_ptr<Sowing> sowing;       ///< if it is sown
    float storedWidening = 1.0f;          ///< of its stored blades, as deltas have them
};

} // namespace sward::render
