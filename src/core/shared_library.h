#pragma once

namespace sward {

/// The address of a function of a shared library, which is opened if the process has not opened it
/// yet, and stays open. Null if there is no such library or function.
void* functionOf(const char* library, const char* function);

} // namespace sward
