#pragma once

#include "apps/lidar/point_file.h"
#include "lidar/lidar.h"

#include <future>

namespace sward::apps {

/// Encodes and writes points in threads of its own, while the next ones are measured.
class PointWriter {
public:
    /// `file` must outlive this. `threads` ≥ 1 encode, one writes.
    PointWriter(PointFile& file, unsigned threads)
        : file_(file)
        , threads_(threads)
    {
    }

    /// Writes the next points, after the former ones; waits for those. Throws what has stopped
    /// them, as PointFile does.
    void add(lidar::ReturnParts parts);

    /// Waits for the last ones. Throws as add() does.
    void finish();

private:
    void write(const lidar::ReturnParts& parts) const;

    PointFile& file_;
    unsigned threads_;
    std::future<void> writing_; ///< waits when it is destroyed
};

} // namespace sward::apps
