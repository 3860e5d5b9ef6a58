#pragma once

#include "lidar/lidar.h"

#include <string>

namespace sward::apps {

/// The beams of a file: place and direction [m] in the world, x y z dx dy dz. Directions need not
/// be unit. Takes .npy of NumPy (float32 or float64, N × 6, in C order), which stays mapped, and
/// .csv with a header that names these columns. Throws Error{io} if it cannot be read, Error{input}
/// with line or row if it is not such a file, Error{unsupported} for another layout of .npy.
lidar::Beams readBeams(const std::string& path);

} // namespace sward::apps
