// Compiles shared headers as C++20 and GLSL 460. The only shared file with a language condition.
#ifndef SWARD_SHARED_TYPES_H
#define SWARD_SHARED_TYPES_H

#ifdef __cplusplus

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/integer.hpp>
#include <glm/mat4x4.hpp>
#include <glm/packing.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>
#include <cstdint>

#define SHARED_BEGIN                                                                               \
    namespace sward::shared {                                                                      \
    using namespace glm;                                                                           \
    using uint = std::uint32_t;
#define SHARED_END }
#define SHARED_FN inline
#define SHARED_CONST inline constexpr
#define SHARED_INOUT(Type) Type&
#define SHARED_UNROLL
#define SHARED_LAYOUT(Type, bytes) static_assert(sizeof(Type) == (bytes));
// A buffer by its device address, a multiple of 8: a number in C++, a typed reference in GLSL.
#define SHARED_BUFFER(Name, Type, access) using Name = std::uint64_t;
// A buffer that shared functions read: in C++ a device address, or an array of the CPU.
#define SHARED_TABLE(Name, Type)                                                                   \
    union Name {                                                                                   \
        std::uint64_t address;                                                                     \
        const Type* at;                                                                            \
    };

#else

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_control_flow_attributes : require

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN
#define SHARED_CONST const
#define SHARED_INOUT(Type) inout Type
// Before a loop over a small array: otherwise a GPU places the array in memory, to index it.
#define SHARED_UNROLL [[unroll]]
#define SHARED_LAYOUT(Type, bytes)
// Aligned to 8 bytes, also where elements are words: the size of the addresses that others hold.
// SPIR-V requires a load of an address to state that alignment, and glslang states the smaller one
// of both buffers, the one that holds the address and the one that it leads to.
#define SHARED_BUFFER(Name, Type, access)                                                          \
    layout(buffer_reference, scalar, buffer_reference_align = 8) access buffer Name                \
    {                                                                                              \
        Type at[];                                                                                 \
    };
// Not readonly: a function argument must not lose a qualifier.
#define SHARED_TABLE(Name, Type) SHARED_BUFFER(Name, Type, )

#endif
#endif
