#pragma once

#include "apps/sward_view/ground_surface.h"
#include "field/inspect.h"
#include "field/read.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace sward::view {

/// A field on the CPU's side, with what the window asks of it.
struct ShownField {
    explicit ShownField(const std::filesystem::path& file);

    field::MappedField mapped;
    field::FieldView view;
    field::Summary summary;
    GroundSurface ground;
    std::string name;  ///< for the title
    std::string input; ///< what the user opened: a field, or the mesh it was grown on
};

/// Reads a field while the window goes on.
class FieldLoader {
public:
    /// `input` is what the user opened, `file` the field to read.
    FieldLoader(std::string input, std::filesystem::path file);
    FieldLoader(const FieldLoader&) = delete;
    FieldLoader& operator=(const FieldLoader&) = delete;
    ~FieldLoader();

    const std::string& input() const { return input_; }

    /// Whether it has ended; never waits.
    bool isDone();

    /// The field, after it has ended. Throws what readField() threw.
    std::unique_ptr<ShownField> take();

private:
    std::string input_;
    std::mutex mutex_;
    bool done_ = false;
    std::unique_ptr<ShownField> field_;
    std::exception_ptr failure_;
    std::thread thread_;
};

} // namespace sward::view
