#pragma once

namespace sward {

// A loop over arrays compiled twice: for every x86-64 CPU, and for those with AVX2. Both give the
// same bits if the loop uses exactly rounded operations only: the build contracts nothing into
// fused operations and reorders nothing. Write the loop as an always-inline function, and call it
// from two functions, one of them marked SWARD_WIDE.

#if defined(__x86_64__)
/// Compiles a function for CPUs that have AVX2.
#define SWARD_WIDE [[gnu::target("avx2")]]

/// Whether this CPU runs functions marked SWARD_WIDE.
inline bool hasWideRegisters()
{
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}
#else
#define SWARD_WIDE
inline bool hasWideRegisters()
{
    return false;
}
#endif

} // namespace sward
