#pragma once

#include "interchange/instances.h"

#include <vector>

namespace sward::interchange {

/// Sorts instances by species, and those of a species along the Morton curve through the cells of a
/// grid of `step` [m] > 0. Neighbours in the order are then neighbours in space, so their
/// differences need few bits. The result does not depend on the order before, unless two roots of
/// a species share a cell; these keep theirs.
void sortForCompression(std::vector<Instance>& instances, float step);

} // namespace sward::interchange
