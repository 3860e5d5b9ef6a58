#pragma once

#include "interchange/instances.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sward::interchange {

/// One attribute of EXT_mesh_gpu_instancing: what it is called and how an instance fills it. Every
/// element is a multiple of four bytes, so that arrays follow one another without gaps, and none is
/// of unsigned integers of 32 bits, which glTF forbids for attributes of one's own.
struct InstanceAttribute {
    const char* name;
    const char* type;  ///< SCALAR, VEC3, VEC4
    int componentType; ///< 5126 float, 5121 unsigned byte, 5123 unsigned short
    bool normalized;
    std::size_t bytes; ///< of one element
    void (*store)(const Instance& instance, std::byte* to);
};

/// TRANSLATION first, then the others, in the order in which they lie in the file.
std::span<const InstanceAttribute> instanceAttributes();

/// One array after the other for `instances`.
std::vector<std::byte> attributeBytes(std::span<const Instance> instances);

} // namespace sward::interchange
