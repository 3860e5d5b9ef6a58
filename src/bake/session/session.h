#pragma once

#include "bake/paint/stroke_contact.h"
#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/cells.h"
#include "field/delta.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace sward::bake {

struct BakePlan;
struct CellTree;

/// A bake that stays open while its ground is painted or sculpted. A change bakes those 32 m cells
/// again that it reaches, and no other. The cells are at any time, byte for byte, those of a whole
/// bake of the session's ground with its strokes. Undo and redo are changes like any other.
///
/// Of a field with seeds, a change of strokes samples the conditions again that it touches, and
/// grows the stored blades of those cells.
///
/// Amount and size of blades are planned once, for the first ground without strokes: a count
/// becomes a local density when the session begins.
class Session {
public:
    /// What a change of strokes or ground changed.
    struct Change {
        std::vector<field::CellIndex> cells; ///< baked again, sorted; some may have no blades now
        std::size_t blades = 0;              ///< in these cells, after the change
    };

    /// Bakes the whole field with the settings' strokes; with seeds if writesSeeds() says so. The
    /// ground must outlive the session; the settings are copied. `threads` 0: all threads of the
    /// machine. `baked`: a field with keys whose blades are used instead, if it was baked of this
    /// ground with these settings; else a warning says why not. Throws as bakeField() does.
    Session(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
            Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked = nullptr);
    Session(Session&&) noexcept; ///< the former one may only be destroyed
    ~Session();

    /// Replaces all strokes; their species must be resolved. Leaves the session as it was if it
    /// throws Error{interrupted} because it was cancelled. Does not test maxBlades.
    Change apply(Strokes strokes, Progress& progress);

    /// Replaces the ground by one of as many triangles in the same order, for example after some of
    /// its vertices have been moved. Bakes the cells again that are near a triangle or an edge that
    /// differs; all cells if the origin, a material or an image differs. The new ground must
    /// outlive the session; the one before is no longer used. Leaves the session as it was if it
    /// throws: Error{input} for another number of triangles, else as bakeField() and apply() do.
    Change replaceGround(const terrain::GroundMesh& ground, Progress& progress);

    /// How much of the strokes from number `first` on touches the ground as it is now.
    std::vector<StrokeContact> contacts(std::size_t first = 0) const;

    const Strokes& strokes() const;            ///< as they are now
    Sides sides() const;                       ///< of triangles that bear grass
    const BakePlan& plan() const;              ///< of the first ground, without strokes
    const terrain::GroundMesh& ground() const; ///< as it is now
    bool hasReused() const;                    ///< the blades of a baked field
    bool hasSeeds() const;                     ///< as its settings say; see writesSeeds()

    /// Cells as they are now, relative to the ground's origin; for receivers of a Change. The
    /// session must not change as long as the delta is used.
    field::Delta deltaOf(std::span<const field::CellIndex> cells) const;

    std::uint64_t bladeCount() const; ///< of all cells

    /// Cells with blades, by number.
    const std::map<field::CellIndex, CellTree>& cells() const;

    /// The whole field, as bakeField() makes it. A copy.
    field::Field field() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Throws Error{input} for more blades after a change than `most`, --max-blades, and than `before`,
/// at the start of the session.
void requireBlades(std::uint64_t blades, std::uint64_t before, std::uint64_t most);

} // namespace sward::bake
