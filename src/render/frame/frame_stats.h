#pragma once

#include <cstdint>
#include <limits>

namespace sward::render {

/// Blade statistics of a frame. resident = drawn + lod + all of culled; total = resident +
/// streamedOut.
struct FrameStats {
    std::uint64_t total = 0;             ///< blades of the field; with seeds, all that would grow
    std::uint64_t streamedOut = 0;       ///< not resident
    std::uint64_t resident = 0;          ///< in memory
    std::uint64_t sown = 0;              ///< of these, grown from the field's seeds
    std::uint64_t simulated = 0;         ///< moved in this frame
    std::uint64_t drawn = 0;             ///< in the picture
    std::uint64_t lod = 0;               ///< thinned out
    std::uint64_t culledPatch = 0;       ///< with their whole patch
    std::uint64_t culledOrientation = 0; ///< seen from their edge
    std::uint64_t culledFrustum = 0;     ///< beside the picture
    std::uint64_t culledDistance = 0;    ///< too far away
    std::uint64_t culledOcclusion = 0;   ///< behind the ground
};

/// What streaming holds and misses of fields larger than their budgets.
struct StreamingStats {
    std::uint64_t pages = 0;          ///< of 1024 blades, of the fields
    std::uint64_t places = 0;         ///< pages that fit into the budgets
    std::uint64_t residentPages = 0;  ///< in device memory
    std::uint64_t residentBlades = 0; ///< of patches that are completely there
    std::uint64_t wantedPages = 0;    ///< with blades that a view draws, by the last census
    std::uint64_t missingPages = 0;   ///< of these, not in device memory

    /// [m] from a view's eye to the nearest blades that it draws, unthinned, and that are not in
    /// device memory; in the space of their field. Infinity if there are none.
    float nearestMissing = std::numeric_limits<float>::infinity();
    std::uint64_t copiedBytes = 0; ///< recorded in the last frame
    float thinning = 1.0f;         ///< largest factor on FrameSettings::lodThreshold, 1 to 8
    bool isSettled = true;         ///< with unchanged views further frames would change nothing
};

} // namespace sward::render
