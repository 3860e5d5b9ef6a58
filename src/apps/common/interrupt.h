#pragma once

namespace sward {
class Progress;
}

namespace sward::apps {

/// While it lives, SIGINT and SIGTERM raise a flag instead of ending the program; a second signal
/// ends it at once. One at a time, made by runProgram().
class InterruptFlag {
public:
    InterruptFlag();
    InterruptFlag(const InterruptFlag&) = delete;
    InterruptFlag& operator=(const InterruptFlag&) = delete;
    ~InterruptFlag();
};

/// Whether a signal has asked the program to end.
bool interruptRequested() noexcept;

/// Throws Error{interrupted} if a signal has asked the program to end; `stage` says during what.
void throwIfInterrupted(const char* stage);

/// While it lives, a signal also cancels `progress`, so that work in a library stops. One at a
/// time.
class CancelOnInterrupt {
public:
    explicit CancelOnInterrupt(Progress& progress);
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
    ~CancelOnInterrupt();
};

} // namespace sward::apps
