#pragma once

#include "apps/sward_view/field_group.h"
#include "apps/sward_view/ground_surface.h"
#include "apps/sward_view/meadow_requests.h"
#include "apps/sward_view/watched_file.h"
#include "field/inspect.h"
#include "field/read.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sward::view {

/// What was opened, and the file that holds its field: itself, or what was baked on it.
struct FieldSource {
    std::string input;                      ///< a field, or a ground
    std::filesystem::path file;             ///< the field
    std::string report;                     ///< of its bake, for people; empty for a field
    WatchedFile watched;                    ///< the input, as it was before it was read
    WatchedFile watchedMeadow;              ///< the file of what was sown, if there is one
    std::optional<MeadowRequests> requests; ///< that it was baked with here
};

/// A field on the CPU's side. It may be shown alone or among others.
struct OpenedField {
    /// Throws what readField() throws.
    explicit OpenedField(FieldSource source);

    FieldSource source;
    std::vector<std::byte> bytes; ///< of the file, unless it is large
    field::MappedField mapped;
    field::Summary summary;
    std::string name; ///< the last part of its input
};
using OpenedFields = std::vector<std::shared_ptr<OpenedField>>;

/// The fields that are shown together, with what the window asks of them.
struct ShownField {
    /// One or more. Throws what field::join() throws.
    explicit ShownField(OpenedFields members);

    /// Whether one of them was opened from `input`.
    bool has(const std::string& input) const;

    OpenedFields members;
    FieldGroup group;
    const field::FieldView& view; ///< of all
    field::Summary summary;       ///< of all
    GroundSurface ground;
    std::string name; ///< for the title
};

/// Reads fields, and joins them with others, while the window goes on.
class FieldLoader {
public:
    /// Reads `sources` and puts them between `others`, the first at `place`.
    FieldLoader(std::vector<FieldSource> sources, OpenedFields others, std::size_t place);
    FieldLoader(const FieldLoader&) = delete;
    FieldLoader& operator=(const FieldLoader&) = delete;
    ~FieldLoader();

    /// What is read, in words.
    const std::string& title() const { return title_; }

    /// Whether it has ended; never waits.
    bool isDone();

    /// The fields, after it has ended. Throws what readField() and join() threw.
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
