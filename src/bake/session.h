#pragma once

#include "bake/cell_triangles.h"
#include "bake/report.h"
#include "bake/settings.h"
#include "bake/tiles/bake_tile.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/delta.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/surface_features.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace sward::bake {

/// A bake that stays open while its ground is painted. A change of strokes bakes those 32 m cells
/// again that it reaches, and no other. The cells are at any time, byte for byte, those of a whole
/// bake with the session's strokes. Undo and redo are changes like any other.
///
/// The amount is planned once, without strokes: a count becomes a local density when the session
/// begins.
class Session {
public:
    /// What a change of strokes changed.
    struct Change {
        std::vector<CellNumber> cells; ///< baked again, sorted; some may have no blades now
        std::size_t blades = 0;        ///< in these cells, after the change
    };

    /// Bakes the whole field with the settings' strokes. The ground must outlive the session; the
    /// settings are copied. `threads` 0: all threads of the machine. `baked`: a field with keys
    /// whose blades are used instead, if it was baked of this ground with these settings; else a
    /// warning says why not. Throws as bakeField() does.
    Session(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
            Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked = nullptr);

    /// Replaces all strokes; their species must be resolved. Leaves the session as it was if it
    /// throws Error{interrupted} because it was cancelled. Does not test maxBlades.
    Change apply(Strokes strokes, Progress& progress);

    const Strokes& strokes() const { return settings_.strokes; }
    const BakePlan& plan() const { return plan_; } ///< without strokes
    bool hasReused() const { return hasReused_; }  ///< the blades of a baked field

    /// Cells as they are now, relative to the ground's origin; for receivers of a Change. The
    /// session must not change as long as the delta is used.
    field::Delta deltaOf(std::span<const CellNumber> cells) const;

    std::uint64_t bladeCount() const; ///< of all cells

    /// Cells with blades, by number.
    const std::map<CellNumber, CellTree>& cells() const { return cells_; }

    /// The whole field, as bakeField() makes it. A copy.
    field::Field field() const;

private:
    bool reuse(const field::FieldView& baked, Diagnostics& diagnostics);
    std::set<CellNumber> cellsReached(const Strokes& next) const;
    void addCells(const Stroke& stroke, std::span<const Stroke> later,
                  std::set<CellNumber>& reached) const;

    const terrain::GroundMesh& ground_;
    BakeSettings settings_;
    int threads_;
    Report report_; ///< of the input
    terrain::SurfaceFeatures features_;
    BakePlan plan_;
    double margin_ = 0.0; ///< [m] of a tile
    std::optional<CellTriangles> triangles_;
    std::set<CellNumber> bearing_; ///< all cells that may have blades
    terrain::GroundMesh part_;     ///< around the cells that were baked last
    std::map<CellNumber, CellTree> cells_;
    bool hasReused_ = false;
};

} // namespace sward::bake
