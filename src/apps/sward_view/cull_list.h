#pragma once

#include <cstdint>
#include <string_view>

namespace sward::view {

/// "all", "none" or a list like "patch,frustum" as bits of shared::cullPatch and so on. Throws
/// Error{usage} for another word. "occlusion" is known but has no bit yet: nothing is culled by it.
std::uint32_t parseCullList(std::string_view text);

} // namespace sward::view
