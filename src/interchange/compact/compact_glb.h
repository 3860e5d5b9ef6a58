#pragma once

#include "core/files/atomic_file.h"
#include "core/progress.h"
#include "field/field.h"
#include "interchange/compact/compact_instances.h"
#include "interchange/export_settings.h"
#include "interchange/gltf/gltf_document.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::interchange {

/// Most blades of one group: twice largestGroup, since the descriptions of small nodes take up to
/// two bytes a blade.
inline constexpr std::uint64_t largestCompactGroup = 65536;

/// What the nodes of compact instances have in common.
struct CompactPlace {
    std::string name;      ///< the species' name is appended
    glm::dvec3 place{0.0}; ///< translation [m]
    Aabb bounds;           ///< of every bent blade [m], relative to `place`
    std::size_t firstMesh; ///< mesh of species 0
};

/// Adds a node for each species of `instances`, and reserves their streams. Returns the nodes.
std::vector<std::size_t> addCompactNodes(GltfDocument& document, const field::FieldView& field,
                                         const CompactInstances& instances,
                                         const CompactPlace& place, const ExportSettings& settings);

/// The streams of `instances`, as addCompactNodes() has reserved them.
std::vector<std::byte> streamBytes(const CompactInstances& instances);

/// writeGlb() with ExportSettings::compact: instances are quantised (CompactAttribute) and
/// compressed by `meshoptExtension`. Compresses the blades once, into a temporary file beside the
/// output. Throws as writeGlb() does, and Error{unsupported} if the file would exceed 4 GiB.
void writeCompactGlb(const field::FieldView& field, const std::filesystem::path& path,
                     const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
