#pragma once

#include "terrain/gltf_buffers.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <string_view>

namespace sward::terrain {

/// The names under which buffer views are compressed by meshoptimizer's codecs.
inline constexpr std::array<std::string_view, 3> meshoptNames = {
    "EXT_meshopt_compression", "KHR_meshopt_compression", "MESHOPT_compression"};

/// Decodes every buffer view of `document` that is compressed with one of meshoptNames into a
/// buffer of its own, and lets the view lie there. Counts are checked against what the compressed
/// bytes can hold before room is made for them. Throws Error{input} naming the view,
/// Error{unsupported} for a codec or a filter beyond meshoptimizer 0.18.
void decompressMeshopt(nlohmann::json& document, GltfBuffers& buffers, const std::string& place);

} // namespace sward::terrain
