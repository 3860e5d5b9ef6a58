#pragma once

#include "shaders/shared/culling.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace sward::render {

/// A culling test and its name in files and on the command line.
struct CullTest {
    std::string_view name;
    std::uint32_t bit; ///< of FrameSettings::cullMask
};

inline constexpr std::array<CullTest, 5> cullTests{{{"patch", shared::cullPatch},
                                                    {"orientation", shared::cullOrientation},
                                                    {"frustum", shared::cullFrustum},
                                                    {"distance", shared::cullDistance},
                                                    {"occlusion", shared::cullOcclusion}}};

} // namespace sward::render
