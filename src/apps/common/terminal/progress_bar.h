#pragma once

#include "core/progress.h"

#include <string>

namespace sward::apps {

/// Shows a Progress on stderr as the log's status line, below the log messages. The destructor
/// removes it. One at a time.
class ProgressBar {
public:
    explicit ProgressBar(bool shown);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();

    /// Callback for a Progress, called from any thread; empty if no bar is shown. The bar must
    /// outlive it.
    Progress::Callback callback();

    /// Removes the line until the next step.
    void clear();

private:
    void show(const std::string& stage, double share);

    const bool shown_;
    const bool colored_;
};

/// The line itself: "sampling  [#####     ]  50 %", at most `columns` wide.
std::string progressLine(const std::string& stage, double share, int columns);

} // namespace sward::apps
