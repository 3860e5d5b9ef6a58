#pragma once

#include "bake/filter/root_filter.h"
#include "bake/ground/tile_region.h"
#include "bake/poisson/dart_part.h"
#include "bake/poisson/poisson_fragments.h"
#include "bake/poisson/poisson_tuning.h"
#include "bake/poisson/region_frame.h"
#include "core/bounds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// The parts of one region, in the order in which darts are thrown at them.
class RegionParts {
public:
    /// All arguments must outlive it. `counted`: see RegionFiller.
    RegionParts(const terrain::GroundMesh& ground, std::uint64_t seed, const RootFilter& filter,
                const PoissonLattice& lattice, double spacing, const PoissonTuning& tuning,
                const TileRegion* counted);

    /// Gathers the sides and parts of these pieces; the parts are placed afterwards. Leaves out
    /// parts that the filter finds bare: the order of the others is as if they were there.
    void gather(std::span<const RegionPiece> pieces);

    /// Whether no part is left.
    bool empty() const { return sides_.empty(); }

    /// Darts of the first pass that would have been thrown at bare parts, by the reason.
    const std::array<std::uint64_t, rejectCount>& bareDarts() const { return bareDarts_; }

    /// A box that contains all positions that darts can hit [m].
    DAabb bounds() const;

    /// Makes the parts of the first pass.
    void place();

    /// The same for a smooth region: also gives them local coordinates in the frame that it
    /// returns, with room for disks `widest` [m] around the parts. `box`: bounds().
    RegionFrame placeIn(const glm::dvec3& normal, const DAabb& box, double widest);

    /// Replaces the parts by their quarters, `times` in succession, without those for which
    /// closed(part, level) holds. `level`: at which its triangle is cut into such parts.
    template <typename Closed>
    void quarter(int times, Closed closed)
    {
        // Each part's quarters in a random rotation, one of each part after the other. So the order
        // of any two is the same, whatever others are closed.
        const std::uint32_t turns = std::uint32_t(1) << 2 * times;
        turns_.resize(turns);
        for (const DartPart& part : parts_) {
            std::uint32_t number = part.share;
            refine(part, sideOf(part).level + pass_, times, number, closed);
        }
        pass_ += times;
        placeTurns();
    }

    std::span<const DartPart> parts() const { return parts_; }
    std::span<const TriangleSide> sides() const { return sides_; }
    const TriangleSide& sideOf(const DartPart& part) const { return sides_[part.side]; }
    int pass() const { return pass_; }

    Fragment fragmentOf(const DartPart& part) const
    {
        return fragmentAt(sideOf(part).level + pass_, part.column, part.row, part.turned);
    }

    /// Number of dart `index` of a part among the candidates of its triangle side.
    std::uint32_t candidate(const DartPart& part, std::uint32_t index) const;

private:
    void addSide(const RegionPiece& piece);
    WeightBound boundOn(const GroundPart& part) const;
    std::uint64_t dartsAt(const TriangleSide& side, const DartPlace& place) const;
    std::uint64_t keyOf(const TriangleSide& side, const DartPlace& place) const;
    std::uint32_t shareOf(std::uint64_t key) const;
    void makeParts();
    void placeTurns();
    void addPart(const DartPlace& place);
    static std::array<DartPart, 4> quartersOf(const DartPart& part);

    template <typename Closed>
    void refine(const DartPart& part, int level, int times, std::uint32_t& number,
                const Closed& closed)
    {
        for (const DartPart& quarter : quartersOf(part)) {
            if (closed(quarter, level + 1))
                number += std::uint32_t(1) << 2 * (times - 1);
            else if (times > 1)
                refine(quarter, level + 1, times - 1, number, closed);
            else
                turns_[number++ % turns_.size()].push_back(
                    {quarter.side, quarter.column, quarter.row, quarter.turned});
        }
    }
    DartPart::Counts countsOf(const TriangleSide& side, const Fragment& fragment) const;

    const terrain::GroundMesh& ground_;
    std::uint64_t seed_;
    const RootFilter& filter_;
    const PoissonLattice& lattice_;
    double spacing_;
    const PoissonTuning& tuning_;
    const TileRegion* counted_;

    std::vector<TriangleSide> sides_;
    std::vector<DartPlace> places_; ///< bare ones too: they keep the order of the others
    std::array<std::uint64_t, rejectCount> bareDarts_{};
    PoissonLattice::Key region_ = 0;
    std::vector<DartPart> parts_;
    std::vector<std::vector<DartPlace>> turns_; ///< places of quarters, by their turn
    int pass_ = 0;
};

} // namespace sward::bake
