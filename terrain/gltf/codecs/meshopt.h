#pragma once

#include "terrain/gltf/file/buffers.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <string_view>

namespace sward::terrain {

/// Extension names of buffer views compressed by meshoptimizer's codecs.
inline constexpr std::array<std::string_view, 3> meshoptNames = {
    "EXT_meshopt_compression", "KHR_meshopt_compression", "MESHOPT_compression"};

/// Decodes every buffer view of `document` compressed with one of meshoptNames into a separate
/// buffer and redirects the view. Checks counts against the size of the compressed bytes before
/// allocation. Throws Error{input} naming the view, Error{unsupported} for a codec or a filter
/// beyond meshoptimizer 0.18.
void decompressMeshopt(nlohmann::json& document, GltfBuffers& buffers, const std::string& place);

} // namespace sward::terrain
