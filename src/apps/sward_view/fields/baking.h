#pragma once

#include "apps/common/temporary_folder.h"
#include "core/error.h"
#include "core/process/child_process.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// Whether `input` is an input of `sward bake` (a mesh, a heightmap, a recipe, the name of a
/// built-in ground) and not a field.
bool wantsBaking(const std::string& input);

/// Progress of a bake: the last line of its progress bar on stderr.
struct BakeProgress {
    std::string state;
    double share = 0.0; ///< [0, 1]
};

/// Parses "sampling  [####  ]  50 %"; none for any other line.
std::optional<BakeProgress> parseProgress(std::string_view line);

/// A bake in another process: the program `sward` beside this one. The destructor ends the process
/// and deletes its files.
class Baking {
public:
    /// `arguments` of `sward bake`, without output, report and progress. `output`: the field to
    /// write, which replaces one that is there; empty: in a temporary folder. Throws Error{io} if
    /// the program is missing, Error{runtime} if it cannot be run.
    explicit Baking(std::vector<std::string> arguments, std::filesystem::path output = {});
    Baking(const Baking&) = delete;
    Baking& operator=(const Baking&) = delete;

    /// Reads its output without waiting. Returns whether it has ended.
    bool poll();

    /// Asks the process to end; poll() reports the end.
    void cancel();

    const BakeProgress& progress() const { return progress_; }
    bool isCancelled() const { return cancelled_; }

    // Valid after it has ended.
    bool succeeded() const;
    int exitCode() const;          ///< exit code of `sward`, or 4 after a signal
    ErrorKind errorKind() const;   ///< of that exit code
    std::string complaint() const; ///< its last message, or how it ended
    const std::filesystem::path& field() const { return field_; }
    std::filesystem::path report() const { return folder_.path() / "report.json"; }

private:
    void takeIn(std::string_view text);
    void takeLine(std::string line);

    apps::TemporaryFolder folder_{"sward-view"};
    std::filesystem::path field_;
    std::unique_ptr<ChildProcess> child_;
    std::string unfinished_;
    std::vector<std::string> lines_; ///< other than progress
    BakeProgress progress_;
    std::optional<ChildProcess::End> end_;
    bool cancelled_ = false;
};

} // namespace sward::view
