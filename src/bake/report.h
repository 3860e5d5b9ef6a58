#pragma once

#include "bake/mask/ground_green.h"
#include "bake/mask/soft_range.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// Reason why a root was rejected. In the order of the tests, cheap tests first.
enum class Reject {
    spacing,
    mask,
    cutout,
    material,
    slope,
    altitude,
    border,
    curvature,
    water,
    clearance,
    exposure,
    occluder,
    excluded,
    paint
};
inline constexpr std::size_t rejectCount = 14;

/// Key of a reason in the report.
const char* nameOf(Reject reason);

/// Number of roots, kept and rejected.
struct RootCounts {
    std::uint64_t kept = 0;                            ///< roots in the field
    std::uint64_t undersides = 0;                      ///< kept roots that face away from ground-up
    std::uint64_t proposed = 0;                        ///< roots before any filter
    std::array<std::uint64_t, rejectCount> rejected{}; ///< by Reject
};

/// Statistics of a bake; explain where no grass grows.
struct Report {
    /// The input ground.
    struct Input {
        std::string path;            ///< file or name
        std::uint64_t triangles = 0; ///< of all materials
        double area = 0.0;           ///< [m²] of bearing triangles, one side
        glm::dvec3 low{0.0};         ///< corner of the world bounds [m]
        glm::dvec3 high{0.0};        ///< opposite corner [m]
        SoftRange altitudes;         ///< [m] of bearing triangles; unbounded unless requested
        std::string hash;            ///< of the content, as hexadecimal digits
        std::string mapSystem;       ///< terrain::systemName() of the ground's; empty without one
    } input;                         ///< the input ground
    std::uint64_t seed = 0;          ///< as requested
    int threads = 0;                 ///< threads used
    double bladeScale = 1.0;         ///< as chosen
    std::uint64_t proposed = 0;      ///< roots before any filter
    std::uint64_t kept = 0;          ///< roots in the field
    std::array<std::uint64_t, rejectCount> rejected{}; ///< by Reject
    double spacingRequested = 0.0;                     ///< [m]; 0: none requested
    double spacingMinimum = 0.0; ///< [m] between roots of one sheet, as stored
    /// ρ: minimum / spacing of a hexagonal packing of as many roots on the ground that bears
    /// (RootPlan::bearing); 0 without Poisson disks. None where it cannot be told, because strokes
    /// thin the roots.
    std::optional<double> relativeRadius = 0.0;
    double densityRequested = 0.0;     ///< [1/m²]
    double densityReached = 0.0;       ///< [1/m²] kept roots per area
    double densityClosed = 0.0;        ///< [1/m²] of a closed sward; 0 unless it decided the amount
    double widening = 1.0;             ///< factor on the width of blades
    bool slopeChosen = false;          ///< by the ground's shape, not by a setting
    SoftRange slope;                   ///< [degrees] of the filter, as requested or chosen
    std::optional<GreenShares> colors; ///< of the bearing ground; none if it has no colours
    bool maskChosen = false;           ///< ground:green, by the colours and not by a setting
    /// A mask, also of a species.
    struct MaskUse {
        std::string mask;  ///< as an option says it
        std::string reads; ///< vertex attribute: COLOR_0, TEXCOORD_1, _MASK …; or empty
    };
    std::vector<MaskUse> masks; ///< what they read
    /// Wall-clock seconds of each stage.
    struct Timing {
        double load = 0;          ///< of the input
        double topology = 0;      ///< triangle connections
        double rays = 0;          ///< ray tree
        double sample = 0;        ///< roots and filters
        double traits = 0;        ///< of blades
        double patches = 0;       ///< patches and blade order
        double write = 0;         ///< of the file
        double total = 0;         ///< including everything between the stages
        double sampleBusy = 0;    ///< processor time of `sample`, of all threads
        double totalBusy = 0;     ///< processor time of the process until its end
    } timing;                     ///< [s]
    std::uint64_t peakMemory = 0; ///< [bytes]
    /// The output file.
    struct Output {
        std::string path;          ///< as requested
        std::uint64_t bytes = 0;   ///< of the file
        std::uint64_t patches = 0; ///< of its tree
    } output;                      ///< the written file
    /// Seeds of the field.
    struct Seeds {
        std::uint64_t cells = 0; ///< of 32 m; 0: none
        std::uint64_t bytes = 0; ///< in the file
        double blades = 0.0;     ///< that grow in all, ribbons included: told by the stored ones
        double stored = 0.0;     ///< [0, 1] share of them that the field's own blades are
    } seeds;                     ///< what bears instead of blades
    std::vector<std::string> warnings; ///< readable text, in order of occurrence
};

/// The report as JSON, the format that the programs print.
std::string toJson(const Report& report);

} // namespace sward::bake
