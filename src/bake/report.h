#pragma once

#include "bake/soft_range.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sward::bake {

/// Why a proposed root was not kept. The order is the order of the tests, cheap before dear.
enum class Reject {
    spacing,
    mask,
    material,
    slope,
    altitude,
    border,
    curvature,
    water,
    clearance,
    exposure,
    occluder,
    excluded
};
inline constexpr std::size_t rejectCount = 12;

/// Key of a reason in the report.
const char* nameOf(Reject reason);

/// How many roots there were, and what became of them.
struct RootCounts {
    std::uint64_t kept = 0;
    std::uint64_t undersides = 0; ///< kept roots that look away from ground-up
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
};

/// What a bake did: the answer to "why is there no grass here".
struct Report {
    struct Input {
        std::string path;
        std::uint64_t triangles = 0;
        double area = 0.0;              ///< [m²] of triangles that may bear grass, one side
        glm::dvec3 low{0.0}, high{0.0}; ///< world bounds [m]
        SoftRange altitudes; ///< [m] of triangles that may bear grass; unbounded if none asked
        std::string hash;
    } input;
    std::uint64_t seed = 0;
    int threads = 0;
    double bladeScale = 1.0;
    std::uint64_t proposed = 0;
    std::uint64_t kept = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
    double spacingRequested = 0.0; ///< [m]; 0 if none was
    double spacingMinimum = 0.0;   ///< [m] of two roots of one sheet, as they are in the field
    double relativeRadius = 0.0;   ///< minimum over that of a hexagonal packing of as many roots
    double densityRequested = 0.0; ///< [1/m²]
    double densityReached = 0.0;   ///< [1/m²] kept roots per area
    struct Timing {
        double load = 0, topology = 0, rays = 0, sample = 0, traits = 0, patches = 0, write = 0,
               total = 0;
    } timing;                     ///< [s]
    std::uint64_t peakMemory = 0; ///< [bytes]
    struct Output {
        std::string path;
        std::uint64_t bytes = 0;
        std::uint64_t patches = 0;
    } output;
    std::vector<std::string> warnings;
};

/// The report as the JSON of the programs' contract.
std::string toJson(const Report& report);

} // namespace sward::bake
