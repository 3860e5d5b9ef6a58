#pragma once

#include "apps/sward_view/fields/field_group.h"
#include "apps/sward_view/fields/meadow_requests.h"
#include "apps/sward_view/files/watched_file.h"
#include "field/inspect.h"
#include "field/read.h"
#include "presentation/ground_surface.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sward::view {

/// An opened input and its field file: the input itself, or the field baked on it.
struct FieldSource {
    std::string input;                      ///< a field, or a ground
    std::filesystem::path file;             ///< the field
    std::string report;                     ///< readable report of the bake; empty for a field
    WatchedFile watched;                    ///< the input, before it was read
    WatchedFile watchedMeadow;              ///< the meadow file, if there is one
    std::optional<MeadowRequests> requests; ///< requests of a bake by this window
};

/// A field in host memory, shown alone or with others.
struct OpenedField {
    /// Throws as readField() does.
    explicit OpenedField(FieldSource source);

    /// Writes the field file. Throws Error{io} as AtomicFile does.
    void write(const std::filesystem::path& path, bool overwrite);

    /// The same, after which the field is saved there.
    void save(const std::filesystem::path& path, bool overwrite);

    /// Whether its only file is the temporary one of a bake by this window.
    bool isUnsaved() const { return source.requests && savedAs.empty(); }

    FieldSource source;
    std::filesystem::path savedAs; ///< empty: not saved
    std::ifstream file;            ///< keeps a temporary file that was removed readable
    std::vector<std::byte> bytes;  ///< content of the file, unless it is large
    field::MappedField mapped;
    field::Summary summary;
    std::string name; ///< the last part of its input
};
using OpenedFields = std::vector<std::shared_ptr<OpenedField>>;

/// The fields shown together, with derived values for the window.
struct ShownField {
    /// One or more members. Throws as field::join() does.
    explicit ShownField(OpenedFields members);

    /// Whether one of them was opened from `input`.
    bool has(const std::string& input) const;

    /// Members that would be lost.
    OpenedFields unsaved() const;

    OpenedFields members;
    FieldGroup group;
    const field::FieldView& view; ///< of all
    field::Summary summary;       ///< of all
    presentation::GroundSurface ground;
    std::string name; ///< window title
};

/// Reads fields and joins them with others in the background.
class FieldLoader {
public:
    /// Reads `sources` and inserts them into `others`, the first at `place`.
    FieldLoader(std::vector<FieldSource> sources, OpenedFields others, std::size_t place);
    FieldLoader(const FieldLoader&) = delete;
    FieldLoader& operator=(const FieldLoader&) = delete;
    ~FieldLoader();

    /// Description of the current work.
    const std::string& title() const { return title_; }

    /// Whether it has finished; never waits.
    bool isDone();

    /// Returns the fields after the end. Throws the errors of readField() and join().
    std::unique_ptr<ShownField> take();

private:
    std::string title_;
    std::mutex mutex_;
    bool done_ = false;
    std::unique_ptr<ShownField> field_;
    std::exception_ptr failure_;
    std::thread thread_;
};

} // namespace sward::view
