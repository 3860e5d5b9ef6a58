#pragma once

#include "core/diagnostics.h"
#include "terrain/load.h"
#include "terrain/topology/soup.h"

#include <glm/mat4x4.hpp>

#include <filesystem>

namespace sward::terrain {

/// Reads the ground of a .gltf or .glb: every triangle of the scene, in world space after
/// `worldFromFile`. Node transforms are multiplied in double precision. Throws Error{io} for a
/// missing file or buffer, Error{input} naming what is wrong, Error{unsupported} naming the
/// extension.
Soup importGltf(const std::filesystem::path& path, const ImportSettings& settings,
                const glm::dmat4& worldFromFile, Diagnostics& diagnostics);

} // namespace sward::terrain
