#pragma once

#include "apps/sward_view/fields/baking.h"
#include "core/process/child_process.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// A stroke of the session that touches no ground, or not with all of it.
struct LostStroke {
    std::size_t stroke = 0;   ///< its number
    std::uint64_t points = 0; ///< of the stroke
    std::uint64_t lost = 0;   ///< points that touch no ground
    double share = 0.0;       ///< of its length
};

/// A stroke that the session has moved.
struct MovedStroke {
    std::size_t stroke = 0; ///< its number
    std::string text;       ///< as it is now
};

/// The first line of `sward edit`.
struct EditReady {
    std::uint64_t blades = 0;
    std::uint64_t strokes = 0;        ///< of --paint
    std::vector<std::string> species; ///< names that strokes may use
    double scale = 1.0;
    bool reused = false; ///< the blades of --field were used
    std::vector<LostStroke> lost;
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
    std::vector<LostStroke> lost;
    std::vector<MovedStroke> moved;
    std::vector<std::string> warnings;
    std::string species; ///< that was looked for; empty: none
};

/// A session of `sward edit` (docs/editing.md) in another process, which ends with this object or
/// with this program. Nothing but the destructor waits.
class EditSession {
public:
    /// Starts `command`: the path of a program and its arguments. Throws Error{runtime} if it
    /// cannot be run.
    explicit EditSession(const std::vector<std::string>& command);
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

    std::unique_ptr<ChildProcess> child_; ///< null: it has ended
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
