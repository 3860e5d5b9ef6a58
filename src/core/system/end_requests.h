#pragma once

#include <chrono>
#include <string_view>

namespace sward {

/// Called when somebody asks the program to end. On Linux it is a signal handler, on Windows it
/// runs on a thread of its own: it may only touch lock-free atomics.
using EndListener = void (*)() noexcept;

/// From now on a request to end calls `listener` instead of ending the program; a second one ends
/// it at once. Requests: on Linux SIGINT, SIGTERM, SIGXCPU, and SIGHUP unless it was ignored, as by
/// nohup; on Windows Ctrl-C, Ctrl-Break, and a console that closes. A file that outgrows its limit
/// (SIGXFSZ) is no request: the write fails. One listener at a time.
void listenToEndRequests(EndListener listener) noexcept;

/// A request ends the program again.
void ignoreEndListener() noexcept;

/// Calls `listener` once after `delay`, in the surroundings of a listener. May be called in one.
void callAfter(std::chrono::milliseconds delay, EndListener listener) noexcept;

/// Writes `words` to stderr and ends the program, without destructors. May be called in a listener.
[[noreturn]] void endAtOnce(std::string_view words, int exitCode) noexcept;

} // namespace sward
