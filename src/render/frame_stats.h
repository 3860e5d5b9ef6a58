#pragma once

#include <cstdint>

namespace sward::render {

/// Blade statistics of a frame. resident = drawn + lod + all of culled; total = resident +
/// streamedOut.
struct FrameStats {
    std::uint64_t total = 0;             ///< blades of the field
    std::uint64_t streamedOut = 0;       ///< not resident
    std::uint64_t resident = 0;          ///< in memory
    std::uint64_t simulated = 0;         ///< moved in this frame
    std::uint64_t drawn = 0;             ///< in the picture
    std::uint64_t lod = 0;               ///< thinned out
    std::uint64_t culledPatch = 0;       ///< with their whole patch
    std::uint64_t culledOrientation = 0; ///< seen from their edge
    std::uint64_t culledFrustum = 0;     ///< beside the picture
    std::uint64_t culledDistance = 0;    ///< too far away
    std::uint64_t culledOcclusion = 0;   ///< behind the ground
};

} // namespace sward::render
