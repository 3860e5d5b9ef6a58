#pragma once

#include "apps/sward_view/baking.h"
#include "apps/sward_view/meadow_requests.h"
#include "apps/sward_view/shown_field.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// What is on its way into the window: fields that are read, or grounds on which one grows first,
/// and those that they are shown among. One order at a time; a new one takes the place of the
/// former.
class Opening {
public:
    struct Order {
        std::vector<std::string> inputs; ///< fields or grounds; none: what is there is joined anew
        OpenedFields among;              ///< that are shown as well
        std::size_t place = 0;           ///< of the first input among them
    };

    /// Begins to read fields, or to bake as `requests` say but on each input that is a ground.
    /// Throws what Baking throws.
    void open(Order order, MeadowRequests requests);

    /// Asks the bake to end.
    void cancel();

    struct Opened {
        std::unique_ptr<ShownField> field;
        std::size_t place = 0; ///< of the first that is new
        std::size_t count = 0; ///< of those that are new
    };

    /// The fields when they are there; never waits. Throws what readField() and join() throw, and
    /// an Error with the baker's exit code. Afterwards nothing is on its way.
    std::optional<Opened> poll();

    bool isBusy() const { return baking() != nullptr || loader_ != nullptr; }
    const Baking* baking() const;
    std::string loading() const { return loader_ ? loader_->title() : std::string(); }

private:
    void goOn();

    Order order_;
    MeadowRequests requests_;
    std::vector<FieldSource> sources_;             ///< found so far
    std::vector<std::unique_ptr<Baking>> bakings_; ///< of the order, the last one may run
    std::unique_ptr<FieldLoader> loader_;
};

/// The report of a bake in a few lines: roots kept, and rejected by reason, the most first.
/// Empty if there is none.
std::string reportText(const std::filesystem::path& report);

} // namespace sward::view
