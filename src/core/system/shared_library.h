#pragma once

#include <string>

namespace sward {

/// The file name of a library, by which the system finds it: "libNAME.so.VERSION", on Windows
/// "NAME-VERSION.dll".
std::string libraryFile(const std::string& name, int version);

/// The address of a function of a shared library, which is opened if the process has not opened it
/// yet, and stays open. Null if there is no such library or function.
void* functionOf(const char* library, const char* function);

} // namespace sward
