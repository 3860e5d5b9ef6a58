#include "gpu/pipeline/exact_arithmetic.h"

#include "core/expect.h"

#include <cstddef>

namespace sward::gpu {
namespace {

// SPIR-V specification, 2.3 and 3.32.
constexpr std::size_t headerWords = 5;
constexpr std::uint32_t opDecorate = 71;
constexpr std::uint32_t opMemberDecorate = 72;
constexpr std::uint32_t noContraction = 42;

/// Whether an instruction computes with floating-point numbers: OpFNegate, OpFAdd, OpFSub, OpFMul,
/// OpFDiv, OpFRem, OpFMod, and OpVectorTimesScalar to OpDot.
bool isArithmetic(std::uint32_t opcode)
{
    return opcode == 127 || opcode == 129 || opcode == 131 || opcode == 133 || opcode == 136 ||
           opcode == 140 || opcode == 141 || (opcode >= 142 && opcode <= 148);
}

} // namespace

std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> words)
{
    // Decorations stand together, before all types and functions.
    std::size_t firstDecoration = 0;
    std::vector<std::uint32_t> added;
    for (std::size_t at = headerWords; at < words.size();) {
        const std::uint32_t opcode = words[at] & 0xffffU;
        const std::size_t length = words[at] >> 16U;
        expect(length > 0 && at + length <= words.size(), "SPIR-V instructions are whole");
        if (firstDecoration == 0 && (opcode == opDecorate || opcode == opMemberDecorate))
            firstDecoration = at;
        if (isArithmetic(opcode))
            added.insert(added.end(), {3U << 16U | opDecorate, words[at + 2], noContraction});
        at += length;
    }
    expect(firstDecoration > 0, "a shader with buffers has decorations");
    std::vector<std::uint32_t> result(words.begin(), words.end());
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(firstDecoration), added.begin(),
                  added.end());
    return result;
}

} // namespace sward::gpu
