#pragma once

#include "field/field.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::field {

/// Counts values in bars of equal width between two edges.
class Histogram {
public:
    /// `high` > `low`; if both are equal, all values go into the first bar.
    Histogram(double low, double high, std::size_t bars);

    /// Values outside the edges count in the first or last bar.
    void add(double value);

    double low() const { return low_; }
    double high() const { return high_; }
    const std::vector<std::uint64_t>& bars() const { return bars_; }
    std::uint64_t count() const { return count_; } ///< the sum of the bars

    // Minimum and maximum of the values themselves; 0 without any.
    double least() const { return count_ == 0 ? 0.0 : least_; }
    double largest() const { return count_ == 0 ? 0.0 : largest_; }
    double mean() const { return count_ == 0 ? 0.0 : sum_ / double(count_); }

private:
    double low_;
    double high_;
    std::vector<std::uint64_t> bars_;
    std::uint64_t count_ = 0;
    double least_ = 0.0;
    double largest_ = 0.0;
    double sum_ = 0.0;
};

/// Maximum number of roots whose nearest neighbour is searched. Fewer if a damaged tree makes the
/// search long.
inline constexpr std::size_t neighbourSamples = 10000;

/// How a field's blades are distributed.
struct Distributions {
    Histogram height;           ///< [m] every blade
    Histogram width;            ///< [m] every blade
    Histogram stiffness;        ///< [0, 1] every blade
    Histogram exposure;         ///< [0, 1] every blade
    Histogram slope;            ///< [degrees], 0 to 180: up-vector against gravity, every blade
    Histogram bladesPerPatch;   ///< every patch that owns blades
    Histogram nearestNeighbour; ///< [m] from up to neighbourSamples roots, spread evenly over the
                                ///< file, to the nearest of all roots; at least two blades
    Histogram density;          ///< [1/m²] every occupied cell
    double cell;                ///< [m] edge of a cell
};

/// One pass over the blades, plus a search for the sampled roots. A cell is a square column along
/// the axis nearest to its blades' up-vectors, continued while gaps are shorter than an edge. The
/// ground below its blades is edge² / |cosine|, if up-vectors are normals of the ground. Ground
/// beyond a border counts, too. The edge is the least power of two ≥ 16 times the median distance
/// of neighbours: some hundred blades in a full cell.
Distributions distributionsOf(const FieldView& field);

struct BladeSize {
    float height = 0.0f;
    float width = 0.02f; ///< at the root
};

/// Mean size [m] of the blades, from the middle of each patch's range. Without blades, the default
/// of BladeSize.
BladeSize meanBladeSize(const FieldView& field);

} // namespace sward::field
