#pragma once

#include "interchange/instances.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sward::interchange {

/// One attribute of EXT_mesh_gpu_instancing and its writer. Every element is a multiple of four
/// bytes, so arrays follow one another without gaps. None is unsigned 32-bit integer, which glTF
/// forbids for custom attributes.
struct InstanceAttribute {
    const char* name;
    const char* type;  ///< SCALAR, VEC3, VEC4
    int componentType; ///< 5126 float, 5121 unsigned byte, 5123 unsigned short
    bool normalized;
    std::size_t bytes; ///< of one element
    void (*store)(const Instance& instance, std::byte* to);
};

/// All attributes in file order, TRANSLATION first. `forEngines`: followed by rank, colours and
/// leaf area.
std::span<const InstanceAttribute> instanceAttributes(bool forEngines = false);

/// The arrays of all these attributes for `instances`, concatenated.
std::vector<std::byte> attributeBytes(std::span<const Instance> instances, bool forEngines = false);

} // namespace sward::interchange
