#pragma once

#include <cstdint>

namespace sward::render {

/// Largest magnitude of the time of a frame [s]: 2³³, 272 years. Beyond it double precision has
/// steps above 1 µs.
inline constexpr double longestTime = 8'589'934'592.0;

/// Longest step from a frame to the next over which blades move on [s]: half of what
/// shared::ticksPerSecond counts, 2.3 hours.
inline constexpr double longestTimeStep = 8192.0;

/// Throws Error{usage} unless `time` [s] is finite and at most longestTime in magnitude.
void requireValidTime(double time);

/// `time` [s] in ticks, see shared::ticksPerSecond, modulo 2³².
std::uint32_t tickOf(double time);

/// Tick of the last update of a blade that is settled in the wind of `time` [s].
std::uint32_t settledTick(double time);

/// Whether blades that were moved to `before` [s] move on to `time`. If time falls, or its step is
/// longer than longestTimeStep, all blades settle in the wind of `time` instead.
bool movesOn(double before, double time);

} // namespace sward::render
