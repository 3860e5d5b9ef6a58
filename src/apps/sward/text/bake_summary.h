#pragma once

#include "apps/common/output.h"
#include "bake/report.h"
#include "terrain/topology/topology.h"

#include <string>

namespace sward::apps {

/// "meadow.sward: 182344 blades in 1212 patches, 3.1 MB, 2.3 s"; `name` comes first.
std::string resultLine(const std::string& name, const bake::Report& report);

/// "kept 182344 of 200000 proposed roots; rejected: 16000 slope, 1656 clearance".
std::string rejectionLine(const bake::Report& report);

/// "load 0.1 s, topology 0.2 s, …"
std::string timingLine(const bake::Report::Timing& timing);

/// Says that the ground's colours chose --mask ground:green, if they did; else empty.
std::string colorLine(const bake::Report& report);

/// Prints the result of a bake: warnings and reasons on the log, the result line on stdout.
void tell(const std::string& name, const bake::Report& report);

/// "topology: 1 component, 40 border edges, 0 creases, 3 non-manifold edges, …"
std::string topologyLine(const terrain::Topology& topology);

} // namespace sward::apps
