#pragma once

#include <cstdint>
#include <string_view>

namespace sward::view {

/// "all", "none" or a list like "patch,frustum,occlusion" as bits of render::CullingTest.
/// Throws Error{usage} for another word.
std::uint32_t parseCullList(std::string_view text);

} // namespace sward::view
