#pragma once

#include "bake/poisson/poisson_tuning.h"
#include "bake/report.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace sward::bake {

/// A triangle side with parts in a region. What every dart reads comes first, in two cache lines.
struct alignas(64) TriangleSide {
    glm::dvec3 corner, first, second; // [m] a corner and its two edges
    glm::vec3 sheetNormal;            // unit; a disk whose normal has at least …
    float sheetCosine;                // … this cosine with it is on the sheet of every root here
    float bound;                      // of RootFilter::weigh() here
    Reject boundReason;               // the factor that lowers it most
    int level;
    std::uint32_t triangle; // index in this ground
    bool back;
    std::uint32_t source; // number in the whole ground
    glm::dvec3 face;      // unit normal of the triangle's front
    glm::dvec3 localCorner{0.0}, localFirst{0.0}, localSecond{0.0}; // in a smooth region
    std::uint64_t tries; // per part and round, times 2²⁴
    std::array<std::uint32_t, PoissonTuning::passes> firstNumber; // of candidates per pass

    glm::dvec3 placeOf(double b, double c) const { return corner + b * first + c * second; }
};

/// Place of a dart in its part: shares of two edges, whose sum is at most 1, in units of 2⁻²⁴.
struct DartShares {
    static constexpr std::int32_t one = 1 << 24;

    std::int32_t u, v;

    explicit DartShares(std::uint64_t bits)
        : u(static_cast<std::int32_t>(bits >> 40))
        , v(static_cast<std::int32_t>(bits >> 8 & (one - 1)))
    {
        // one − u and one − v where they are beyond the third edge; no branch could be foreseen.
        const std::int32_t beyond = (one - u - v) >> 31;
        u = (u ^ beyond) + ((one + 1) & beyond);
        v = (v ^ beyond) + ((one + 1) & beyond);
    }
};

/// Place of a part on its triangle, before darts fly.
struct DartPlace {
    static constexpr std::uint32_t bare = 0xffffffffU;

    std::uint32_t side; ///< index of its triangle side, or `bare`
    std::uint16_t column;
    std::uint16_t row;
    bool turned;
};

/// One of the 4^(level + pass) parts of its triangle, with what darts at it need; a cache line.
struct DartPart {
    /// Which of its darts a tile counts.
    enum class Counts : std::uint8_t { none, all, some };

    glm::vec3 corner, first, second; ///< local, in a smooth region
    std::uint32_t side;              ///< index of its triangle side
    std::uint64_t key;               ///< of its random numbers
    std::uint32_t tries;             ///< per round, times 2²⁴
    std::uint32_t share;             ///< added before rounding, below 2²⁴
    std::uint16_t column;
    std::uint16_t row;
    bool turned;
    Counts counts;

    glm::vec3 local(const DartShares& shares) const
    {
        const float u = static_cast<float>(shares.u) * 0x1.0p-24f;
        const float v = static_cast<float>(shares.v) * 0x1.0p-24f;
        return corner + u * first + v * second;
    }
};

} // namespace sward::bake
