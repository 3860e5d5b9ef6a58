#pragma once

#include "apps/sward_view/fields/baking.h"
#include "apps/sward_view/fields/meadow_requests.h"
#include "apps/sward_view/fields/shown_field.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Loads fields into the window: reads field files, and first bakes the inputs that are grounds.
/// Keeps the fields shown with them. One order at a time; a new one replaces the former.
class Opening {
public:
    struct Order {
        std::vector<std::string> inputs; ///< fields or grounds; none: joins `among` again
        OpenedFields among;              ///< other shown fields
        std::size_t place = 0;           ///< position of the first input among them
    };

    /// Starts reading fields; bakes each ground by `requests`, with the input as its ground. Throws
    /// as Baking does.
    void open(Order order, MeadowRequests requests);

    /// Asks the bake to end.
    void cancel();

    struct Opened {
        std::unique_ptr<ShownField> field;
        std::size_t place = 0; ///< position of the first new field
        std::size_t count = 0; ///< number of new fields
    };

    /// Returns the fields when they are ready; never waits. Throws as readField() and join() do,
    /// and an Error with the baker's exit code. The order has then ended.
    std::optional<Opened> poll();

    bool isBusy() const { return baking() != nullptr || loader_ != nullptr; }
    const Baking* baking() const;
    std::string loading() const { return loader_ ? loader_->title() : std::string(); }

private:
    void goOn();

    Order order_;
    MeadowRequests requests_;
    std::vector<FieldSource> sources_;             ///< found so far
    std::vector<std::unique_ptr<Baking>> bakings_; ///< bakes of the order; the last may be running
    std::unique_ptr<FieldLoader> loader_;
};

/// Readable summary of a bake report: roots kept, and rejected by reason, largest first. Empty if
/// there is none.
std::string reportText(const std::filesystem::path& report);

} // namespace sward::view
