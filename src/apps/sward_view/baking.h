#pragma once

#include "apps/sward_view/temporary_folder.h"
#include "core/error.h"

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// Whether `input` is something that `sward bake` takes (a mesh, a heightmap, a recipe, the name of
/// a built-in ground) and not a field.
bool wantsBaking(const std::string& input);

/// What a bake has to say from time to time on stderr: the last line of its progress bar.
struct BakeProgress {
    std::string state;
    double share = 0.0; ///< [0, 1]
};

/// Reads "sampling  [####  ]  50 %"; nothing if the line is another.
std::optional<BakeProgress> parseProgress(std::string_view line);

/// A field that grows in another process: the program `sward` that lies beside this one. Ends that
/// process, and takes away all that it has written, when this object goes.
class Baking {
public:
    /// `arguments` of `sward bake`, beside those for output, report and progress. Throws Error{io}
    /// if the program is not there, Error{runtime} if it cannot be run.
    explicit Baking(std::vector<std::string> arguments);
    Baking(const Baking&) = delete;
    Baking& operator=(const Baking&) = delete;
    ~Baking();

    /// Takes in what it has said; never waits. Whether it has ended.
    bool poll();

    /// Asks it to end; poll() will see it.
    void cancel();

    const BakeProgress& progress() const { return progress_; }
    bool isCancelled() const { return cancelled_; }

    // After it has ended.
    bool succeeded() const;
    int exitCode() const;          ///< as one of `sward`, or 4 if a signal ended it
    ErrorKind errorKind() const;   ///< of that exit code
    std::string complaint() const; ///< what it said last, or how it was ended
    std::filesystem::path field() const { return folder_.path() / "field.sward"; }
    std::filesystem::path report() const { return folder_.path() / "report.json"; }

private:
    void takeIn(std::string_view text);
    void takeLine(std::string line);

    TemporaryFolder folder_;
    pid_t child_ = -1;
    int said_ = -1; ///< its stderr
    std::string unfinished_;
    std::vector<std::string> lines_; ///< that are not progress
    BakeProgress progress_;
    std::optional<int> status_; ///< of waitpid()
    bool cancelled_ = false;
};

} // namespace sward::view
