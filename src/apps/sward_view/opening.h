#pragma once

#include "apps/sward_view/baking.h"
#include "apps/sward_view/meadow_wishes.h"
#include "apps/sward_view/shown_field.h"

#include <memory>
#include <optional>
#include <string>

namespace sward::view {

/// What is on its way into the window: a field that is read, or a ground on which one grows first.
/// One at a time; a new one takes the place of the former.
class Opening {
public:
    /// Begins to read a field, or to bake as `wishes` say but on `input`. Throws what Baking
    /// throws.
    void open(const std::string& input, MeadowWishes wishes);

    /// Asks the bake to end.
    void cancel();

    struct Opened {
        std::unique_ptr<ShownField> field;
        std::string report; ///< of its bake, for people; empty for a field file
    };

    /// The field when it is there; never waits. Throws what readField() throws, and an Error with
    /// the baker's exit code. Afterwards nothing is on its way.
    std::optional<Opened> poll();

    const Baking* baking() const { return loader_ ? nullptr : baking_.get(); }
    std::string loading() const { return loader_ ? loader_->input() : std::string(); }
    const std::string& input() const { return input_; }

private:
    void startToRead();

    std::string input_;
    std::string report_;
    std::unique_ptr<Baking> baking_;
    std::unique_ptr<FieldLoader> loader_;
};

/// The report of a bake in a few lines: roots kept, and rejected by reason, the most first.
/// Empty if there is none.
std::string reportText(const std::filesystem::path& report);

} // namespace sward::view
