#pragma once

#include "core/diagnostics.h"
#include "terrain/topology/soup.h"

#include <string>

namespace sward::terrain {

/// Warns of nodes of a soup in world space that are so small and so far from the others that single
/// precision around their common middle does not keep their shape: at least 1 % of the node's area
/// lies in triangles of fewer than a hundred steps.
void warnOfRounding(const Soup& soup, const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
