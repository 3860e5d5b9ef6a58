#pragma once

namespace sward {
class Progress;
}

namespace sward::apps {

/// During its lifetime, a signal that asks the program to end (core/system/end_requests.h: SIGINT,
/// SIGTERM, SIGXCPU, SIGHUP; Ctrl-C on Windows) sets a flag instead; a second one ends it
/// immediately. One at a time, made by runProgram().
class InterruptFlag {
public:
    InterruptFlag();
    InterruptFlag(const InterruptFlag&) = delete;
    InterruptFlag& operator=(const InterruptFlag&) = delete;
    ~InterruptFlag();
};

/// From now on a signal ends the program after 0.8 s, if work that does not ask has not stopped by
/// then: temporary files are removed and the exit code is 130. For programs without a window.
void boundInterrupts() noexcept;

/// Whether a signal was received.
bool interruptRequested() noexcept;

/// Throws Error{interrupted} if a signal was received; `stage` names the current work.
void throwIfInterrupted(const char* stage);

/// During its lifetime, a signal also cancels `progress`, so that library work stops. One at a
/// time.
class CancelOnInterrupt {
public:
    explicit CancelOnInterrupt(Progress& progress);
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
    ~CancelOnInterrupt();
};

} // namespace sward::apps
