#pragma once

#include "apps/common/temporary_folder.h"
#include "apps/sward_view/fields/picking.h"
#include "apps/sward_view/paint/autosave_writer.h"
#include "apps/sward_view/paint/edit_session.h"
#include "apps/sward_view/paint/lost_strokes.h"
#include "apps/sward_view/paint/stroke_list.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Paints a field: keeps the session of `sward edit` at the strokes of a list. At most one request
/// is under way; the newest state follows.
class Painter {
public:
    /// `command`: of the session. `held`: the strokes that it begins with, those of --paint.
    /// `autosave`: follows each finished stroke. `folder` may be null: files of the command, kept
    /// as long as it runs. Throws as EditSession does.
    Painter(std::vector<std::string> command, const std::vector<std::string>& held,
            Autosave autosave, std::unique_ptr<apps::TemporaryFolder> folder = nullptr);

    /// Writes strokes that are not saved to the autosave, unless they were discarded.
    ~Painter();

    StrokeList strokes;

    /// Takes the session's answers, hands delta files to `apply` and removes them, asks for what is
    /// new, and writes the autosave. Never waits.
    void poll(const std::function<void(const std::filesystem::path&)>& apply);

    /// The shown field has lost all strokes: the next requests give them anew.
    void repeatAll() { mustClear_ = true; }
    /// Moves visible strokes onto the ground by up to this distance [m], when the session has them.
    void moveStrokes(double distance) { moveBy_ = distance; }
    const LostStrokes& lost() const { return lost_; } ///< that touch no ground
    /// Asks for the species of the blade that is seen there; takeTold() tells it. `farthest` [m].
    void lookForSpecies(const Sight& sight, double farthest);

    /// Writes the field, or the visible strokes, when the session has all of them.
    void saveField(const std::filesystem::path& path, bool overwrite);
    void saveStrokes(const std::filesystem::path& path, bool overwrite);
    /// Waits until that field is written. Throws Error{io} if it is not.
    void saveFieldNow(const std::filesystem::path& path, bool overwrite);
    /// Writes the finished strokes itself. Throws Error{io}.
    void writeStrokes(const std::filesystem::path& path);
    /// Removes the autosave of strokes that are not wanted.
    void discard() { autosave_.discard(strokes); }

    /// What poll() has to tell the user; once each.
    struct Told {
        bool isError = false;
        std::string text;
        std::filesystem::path field{}; ///< that was saved
        std::string species{};         ///< that was looked for
    };
    std::optional<Told> takeTold();

    const EditSession& session() const { return session_; }
    bool isReady() const { return session_.isReady() && session_.failure().empty(); }
    /// Whether the session has all strokes, and all files are written, the autosave among them.
    bool isIdle() const;
    /// Whether the shown field has changed.
    bool hasPainted() const { return hasPainted_; }
    /// The file that holds the field with the strokes as they are; empty: none.
    std::filesystem::path savedField() const;

    std::uint64_t total() const { return total_; } ///< blades of the field
    double seconds() const { return seconds_; }    ///< of the last request with a change
    /// Writes what is not saved to the autosave, and returns its name; empty: nothing is written.
    std::filesystem::path finishAutosave();
    const std::string& autosaveTrouble() const { return autosave_.trouble(); } ///< empty: none

private:
    enum class Asked { nothing, paint, move, species, saveField, saveStrokes };
    struct Saving {
        Asked what;
        std::filesystem::path path;
        bool overwrite;
    };

    void takeAnswer(const EditAnswer& answer,
                    const std::function<void(const std::filesystem::path&)>& apply);
    void takeLost(const std::vector<LostStroke>& lost, std::size_t first);
    void takeMoved(const EditAnswer& answer);
    void askNext();
    void askPaint(const std::vector<std::string>& wanted, std::uint64_t revision);

    std::unique_ptr<apps::TemporaryFolder> folder_;
    EditSession session_;
    AutosaveWriter autosave_;
    std::vector<std::string> held_;  ///< strokes of the session
    std::vector<std::string> asked_; ///< those that it is to have
    Asked under_ = Asked::nothing;   ///< the request under way
    std::uint64_t askedRevision_ = 0;
    std::uint64_t heldRevision_ = 0; ///< what was answered last, or refused
    std::size_t askedKeep_ = 0;      ///< strokes that it had already
    LostStrokes lost_;
    std::optional<double> moveBy_; ///< to be asked for [m]
    std::string look_;             ///< keys of the request for a species; empty: none
    bool hasToldLost_ = false;
    bool mustClear_ = false;
    std::vector<Saving> savings_;
    std::uint64_t savedRevision_ = 0; ///< of finished strokes, while they are being saved
    bool hasPainted_ = false;
    std::filesystem::path field_;     ///< that was saved last
    std::uint64_t fieldRevision_ = 0; ///< of its finished strokes
    std::uint64_t total_ = 0;
    double seconds_ = 0.0;
    std::vector<Told> told_;
};

} // namespace sward::view
