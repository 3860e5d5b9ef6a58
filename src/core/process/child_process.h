#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward {

/// What a child does with its standard streams.
enum class ChildTalk {
    says,    ///< its stdin is that of this program; stdout and stderr come by said()
    takes,   ///< its stdin comes by offer() and give(); stdout and stderr come by said()
    answers, ///< its stdin comes by offer() and give(), stdout by answered(), stderr by said()
};

/// Another program that runs beside this one and tells it what it does. The destructor ends it.
class ChildProcess {
public:
    /// Starts the program `arguments[0]`, a path; all arguments are UTF-8. Throws Error{runtime}
    /// naming the program if it cannot be run.
    explicit ChildProcess(const std::vector<std::string>& arguments,
                          ChildTalk talk = ChildTalk::says);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess();

    /// How it ended.
    struct End {
        std::optional<int> exitCode; ///< none if something else ended it
        std::string reason;          ///< what did then: "signal 9 (Killed)"
    };

    /// What it has written since the last call. Never waits.
    std::string said();

    /// What it has written to stdout since the last call, at most 4 MiB. None: its stdout has
    /// ended, and all of it was told. Never waits.
    std::optional<std::string> answered();

    /// Gives it bytes of its stdin, as many as it takes without waiting. Returns their number: 0
    /// also if it reads no more.
    std::size_t offer(std::string_view bytes);

    /// Gives it bytes of its stdin and waits until it has them, or the system for it. Returns
    /// whether it took them all: not if it reads no more.
    bool give(std::string_view bytes);

    /// Ends its stdin. What was offered and is not on its way is lost.
    void endInput();

    /// Its end; none while it runs. Never waits. What it has said stays until said() is called.
    std::optional<End> end();

    /// The same, after waiting for it no longer than `patience`.
    std::optional<End> endWithin(std::chrono::milliseconds patience);

    /// Asks it to end, as an EndListener hears it.
    void askToEnd();

private:
    struct Handles;
    std::unique_ptr<Handles> handles_; ///< those of the system
};

/// What a program has said until its end, and how it ended.
struct ChildResult {
    std::string said;
    ChildProcess::End end;
};

/// Runs the program `arguments[0]` and waits for its end. Throws as ChildProcess does.
ChildResult runChild(const std::vector<std::string>& arguments);

} // namespace sward
