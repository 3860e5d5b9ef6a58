#pragma once

#include "apps/common/temporary_folder.h"
#include "apps/sward_view/paint/edit_session.h"
#include "apps/sward_view/paint/stroke_list.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
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
    /// `autosave`: a stroke file that follows each finished stroke. `folder` may be null: files of
    /// the command, kept as long as it runs. Throws as EditSession does.
    Painter(std::vector<std::string> command, const std::vector<std::string>& held,
            std::filesystem::path autosave,
            std::unique_ptr<apps::TemporaryFolder> folder = nullptr);

    StrokeList strokes;

    /// Takes the session's answers, hands delta files to `apply` and removes them, asks for what is
    /// new, and writes the autosave. Never waits.
    void poll(const std::function<void(const std::filesystem::path&)>& apply);

    /// The shown field has lost all strokes: the next requests give them anew.
    void repeatAll() { mustClear_ = true; }

    /// Writes the field, or the visible strokes, when the session has all of them.
    void saveField(const std::filesystem::path& path, bool overwrite);
    void saveStrokes(const std::filesystem::path& path, bool overwrite);

    /// Waits until that field is written. Throws Error{io} if it is not.
    void saveFieldNow(const std::filesystem::path& path, bool overwrite);

    /// Writes the finished strokes itself. Throws Error{io}.
    void writeStrokes(const std::filesystem::path& path);

    /// The strokes are not wanted: removes the autosave.
    void discard() { removeAutosave(); }

    /// What poll() has to tell the user; once each.
    struct Told {
        bool isError = false;
        std::string text;
        std::filesystem::path field; ///< that was saved
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
    const std::filesystem::path& autosave() const { return autosave_; }

private:
    enum class Asked { nothing, paint, saveField, saveStrokes };
    struct Saving {
        Asked what;
        std::filesystem::path path;
        bool overwrite;
    };

    void takeAnswer(const EditAnswer& answer,
                    const std::function<void(const std::filesystem::path&)>& apply);
    void askNext();
    void askPaint(const std::vector<std::string>& wanted, std::uint64_t revision);
    void writeAutosave();
    void finishAutosave();
    void removeAutosave();

    std::unique_ptr<apps::TemporaryFolder> folder_;
    EditSession session_;
    std::filesystem::path autosave_;
    std::vector<std::string> held_;  ///< strokes of the session
    std::vector<std::string> asked_; ///< those that it is to have
    Asked under_ = Asked::nothing;   ///< the request under way
    std::uint64_t askedRevision_ = 0;
    std::uint64_t heldRevision_ = 0; ///< what was answered last, or refused
    bool mustClear_ = false;
    std::vector<Saving> savings_;
    std::uint64_t savedRevision_ = 0;     ///< of finished strokes, while they are being saved
    std::uint64_t autosavedRevision_ = 0; ///< of finished strokes
    std::future<std::string> autosaving_; ///< writes the autosave; its error, or nothing
    bool hasPainted_ = false;
    std::filesystem::path field_;     ///< that was saved last
    std::uint64_t fieldRevision_ = 0; ///< of its finished strokes
    std::uint64_t total_ = 0;
    double seconds_ = 0.0;
    std::vector<Told> told_;
};

} // namespace sward::view
