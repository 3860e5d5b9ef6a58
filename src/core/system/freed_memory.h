#pragma once

namespace sward {

/// Keeps memory that the program frees for its next allocations, also large ones, instead of giving
/// it back: a program that makes arrays of many megabytes again and again is spared the system's
/// work on each of their pages. Call once, before there are threads. Does nothing on Windows.
void keepFreedMemory();

} // namespace sward
