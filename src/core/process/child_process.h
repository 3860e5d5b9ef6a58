#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward {

/// Another program that runs beside this one and tells it what it does. Its stdin is that of this
/// program. The destructor ends it.
class ChildProcess {
public:
    /// Starts the program `arguments[0]`, a path; all arguments are UTF-8. Throws Error{runtime}
    /// naming the program if it cannot be run.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess();

    /// How it ended.
    struct End {
        std::optional<int> exitCode; ///< none if something else ended it
        std::string reason;          ///< what did then: "signal 9 (Killed)"
    };

    /// What it has written to stdout and stderr since the last call. Never waits.
    std::string said();

    /// Its end; none while it runs. Never waits. What it has said stays until said() is called.
    std::optional<End> end();

    /// Asks it to end, as an EndListener hears it.
    void askToEnd();

private:
    struct Handles;
    std::unique_ptr<Handles> handles_; ///< those of the system
};

} // namespace sward
