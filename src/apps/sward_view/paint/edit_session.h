#pragma once

#include "apps/sward_view/baking.h"

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// The first line of `sward edit`.
struct EditReady {
    std::uint64_t blades = 0;
    std::uint64_t strokes = 0;        ///< of --paint
    std::vector<std::string> species; ///< names that strokes may use
    double scale = 1.0;
    bool reused = false; ///< the blades of --field were used
    std::vector<std::string> warnings;
};

/// An answer of `sward edit`; what it does not tell stays as it is here.
struct EditAnswer {
    std::uint64_t id = 0;        ///< of the request
    std::string error;           ///< why the request failed; empty: it did not
    std::filesystem::path delta; ///< empty: no cell has changed
    std::uint64_t blades = 0;    ///< in the changed cells
    std::uint64_t total = 0;     ///< blades of the field
    double seconds = 0.0;
    std::string saved; ///< file that was written
};

/// A session of `sward edit` (docs/editing.md) in another process, which ends with this object or
/// with this program. Nothing but the destructor waits.
class EditSession {
public:
    /// Starts `command`: the path of a program and its arguments. Throws Error{runtime} if it
    /// cannot be run.
    explicit EditSession(std::vector<std::string> command);
    EditSession(const EditSession&) = delete;
    EditSession& operator=(const EditSession&) = delete;
    ~EditSession();

    /// Sends a request, whose keys but "id" are the JSON text `keys`: `"do":"quit"`. Returns its
    /// id.
    std::uint64_t ask(std::string_view keys);

    /// Reads and writes what can be without waiting.
    void poll();

    /// The next answer, in the order of requests; none yet: empty.
    std::optional<EditAnswer> take();

    bool isReady() const { return ready_.has_value(); }
    const EditReady& ready() const { return *ready_; } ///< if isReady()
    const BakeProgress& progress() const { return progress_; }

    /// Why it cannot go on: it ended, or said what is no answer. Empty: it can.
    const std::string& failure() const { return failure_; }

private:
    void writeOut();
    void takeLine(const std::string& line);
    void takeAnswer(const std::string& line);
    void takeSaid(std::string_view text);
    void end(std::string why);
    void close();

    pid_t child_ = -1;
    int asks_ = -1;    ///< its stdin
    int answers_ = -1; ///< its stdout
    int said_ = -1;    ///< its stderr
    std::string outgoing_;
    std::string incoming_;
    std::string unfinished_; ///< line of its stderr
    std::string lastSaid_;
    std::uint64_t lastId_ = 0;
    std::uint64_t answered_ = 0; ///< id of the last answer
    std::optional<EditReady> ready_;
    std::deque<EditAnswer> taken_;
    BakeProgress progress_;
    std::string failure_;
};

} // namespace sward::view
