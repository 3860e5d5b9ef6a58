#pragma once

namespace CLI {
class App;
}

namespace sward::apps {

/// The switches -q, -v and --progress. Must not move while a CLI::App refers to it.
struct LogSwitches {
    enum class Bar { automatic, always, never };

    bool quiet = false;   ///< warnings and errors only, no progress bar in `automatic`
    bool verbose = false; ///< debug messages too
    Bar bar = Bar::automatic;

    /// Adds -q/--quiet and -v/--verbose to `app`.
    void add(CLI::App& app);

    /// Adds --progress auto|always|never to `app`.
    void addBar(CLI::App& app);

    /// Sets the log level.
    void apply() const;

    /// Whether a progress bar is to be shown: in `automatic` only on a terminal.
    bool showBar() const;
};

} // namespace sward::apps
