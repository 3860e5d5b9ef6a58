#pragma once

#include "core/files/file_lock.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// What strokes are painted on.
struct AutosaveSubject {
    std::string name;   ///< begins the names of files: NAME.strokes.autosave.json
    std::string input;  ///< absolute path of the field or ground, or a built-in's name
    std::string ground; ///< hash of the ground; empty: not known
};

/// The stroke file of a painting that is not saved. Each painting has one of its own, which a lock
/// file beside it keeps for it: NAME.strokes.autosave.json, or NAME.strokes.autosave-2.json and so
/// on while another has that. The lock file tells what is painted, and by which process.
class Autosave {
public:
    /// `folders`: where the file may lie; the first that takes it does. Writes nothing yet.
    Autosave(AutosaveSubject subject, std::vector<std::filesystem::path> folders);
    Autosave(Autosave&&) noexcept = default;
    Autosave& operator=(Autosave&&) = delete;
    ~Autosave();

    /// Takes over the file of a painting that has ended. Returns whether it could: not if another
    /// painting has it, or it is gone. Throws Error{io} if its lock file cannot be made.
    bool adopt(const std::filesystem::path& path);

    /// Replaces the content. Throws Error{io} with the reason if no folder takes it; what was
    /// written before stays.
    void write(std::string_view text);

    /// Removes the file. The next write() makes one again.
    void remove();

    /// The file; empty if there is none.
    const std::filesystem::path& path() const { return path_; }

private:
    bool claimIn(const std::filesystem::path& folder);
    bool writeIn(const std::filesystem::path& folder, std::string_view text);
    void letGo();

    AutosaveSubject subject_;
    std::vector<std::filesystem::path> folders_;
    std::filesystem::path path_;
    std::optional<FileLock> lock_;
    std::string trouble_; ///< of the last folder that was tried
};

/// An autosave whose painting has ended without saving.
struct LeftStrokes {
    std::filesystem::path path;              ///< the stroke file
    std::filesystem::file_time_type written; ///< when
    bool isOtherGround = false;              ///< the ground had another content
};

/// Autosaves of paintings of `subject` that have ended, the newest first. Those of others, and of a
/// process that still runs, are left out.
std::vector<LeftStrokes> leftStrokes(const AutosaveSubject& subject,
                                     const std::vector<std::filesystem::path>& folders);

/// Removes the autosave of a painting that has ended. Returns whether it did: not if a painting has
/// it now. Throws Error{io} if it cannot be removed.
bool removeLeft(const std::filesystem::path& path);

} // namespace sward::view
