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
    std::uint64_t kept = 0;                            ///< roots of the field
    std::uint64_t undersides = 0;                      ///< kept roots that look away from ground-up
    std::uint64_t proposed = 0;                        ///< roots before any filter
    std::array<std::uint64_t, rejectCount> rejected{}; ///< by Reject
};

/// What a bake did: the answer to "why is there no grass here".
struct Report {
    /// The ground.
    struct Input {
        std::string path;            ///< file or name
        std::uint64_t triangles = 0; ///< of all materials
        double area = 0.0;           ///< [m²] of triangles that may bear grass, one side
        glm::dvec3 low{0.0};         ///< corner of the world bounds [m]
        glm::dvec3 high{0.0};        ///< and the other
        SoftRange altitudes;    ///< [m] of triangles that may bear grass; unbounded if none asked
        std::string hash;       ///< of the content, as hexadecimal digits
    } input;                    ///< what grass was to grow on
    std::uint64_t seed = 0;     ///< as it was asked for
    int threads = 0;            ///< that took part
    double bladeScale = 1.0;    ///< as it was chosen
    std::uint64_t proposed = 0; ///< roots before any filter
    std::uint64_t kept = 0;     ///< roots of the field
    std::array<std::uint64_t, rejectCount> rejected{}; ///< by Reject
    double spacingRequested = 0.0;                     ///< [m]; 0 if none was
    double spacingMinimum = 0.0;   ///< [m] of two roots of one sheet, as they are in the field
    double relativeRadius = 0.0;   ///< minimum over that of a hexagonal packing of as many roots
    double densityRequested = 0.0; ///< [1/m²]
    double densityReached = 0.0;   ///< [1/m²] kept roots per area
    /// Wall-clock seconds of each stage.
    struct Timing {
        double load = 0;          ///< of the input
        double topology = 0;      ///< which triangles meet
        double rays = 0;          ///< the tree for rays
        double sample = 0;        ///< roots and filters
        double traits = 0;        ///< of blades
        double patches = 0;       ///< and their order
        double write = 0;         ///< of the file
        double total = 0;         ///< and what lies between
    } timing;                     ///< [s]
    std::uint64_t peakMemory = 0; ///< [bytes]
    /// The file.
    struct Output {
        std::string path;              ///< as it was asked for
        std::uint64_t bytes = 0;       ///< of the file
        std::uint64_t patches = 0;     ///< of its tree
    } output;                          ///< what was written
    std::vector<std::string> warnings; ///< for people, in the order of the work
};

/// The report as the JSON of the programs' contract.
std::string toJson(const Report& report);

} // namespace sward::bake
