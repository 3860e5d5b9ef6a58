#pragma once

#include "core/progress.h"

#include <string>

namespace sward::apps {

/// A line on stderr that shows how far a Progress has come: the log's status line, above which log
/// messages are written. It is taken away in the end. One at a time.
class ProgressBar {
public:
    explicit ProgressBar(bool shown);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();

    /// What a Progress calls, from any thread; empty if nothing is to be shown. The bar must
    /// outlive it.
    Progress::Callback callback();

    /// Takes the line away until the next step.
    void clear();

private:
    void show(const std::string& stage, double share);

    const bool shown_;
    const bool colored_;
};

/// The line itself: "sampling  [#####     ]  50 %", at most `columns` wide.
std::string progressLine(const std::string& stage, double share, int columns);

} // namespace sward::apps
