#include "apps/sward/text/bake_summary.h"

#include "apps/common/output.h"
#include "core/log.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace sward::apps {

std::string resultLine(const std::string& name, const bake::Report& report)
{
    const std::string seeds =
        report.seeds.cells == 0
            ? std::string()
            : fmt::format("seeds of {:.3g} blades in {} cells ({}), ", report.seeds.blades,
                          report.seeds.cells, sizeText(report.seeds.bytes));
    return fmt::format("{}: {} blades in {} patches, {}{}, {:.1f} s", name, report.kept,
                       report.output.patches, seeds, sizeText(report.output.bytes),
                       report.timing.total);
}

std::string rejectionLine(const bake::Report& report)
{
    std::string line = fmt::format("kept {} of {} proposed roots", report.kept, report.proposed);
    const char* separator = "; rejected: ";
    for (std::size_t i = 0; i < bake::rejectCount; ++i) {
        if (report.rejected[i] == 0)
            continue;
        line += fmt::format("{}{} {}", separator, report.rejected[i],
                            bake::nameOf(static_cast<bake::Reject>(i)));
        separator = ", ";
    }
    return line;
}

std::string timingLine(const bake::Report::Timing& timing)
{
    const std::array<std::pair<const char*, double>, 8> stages{{{"load", timing.load},
                                                                {"topology", timing.topology},
                                                                {"rays", timing.rays},
                                                                {"sample", timing.sample},
                                                                {"traits", timing.traits},
                                                                {"patches", timing.patches},
                                                                {"write", timing.write},
                                                                {"total", timing.total}}};
    std::string line;
    for (const auto& [name, seconds] : stages)
        line += fmt::format("{}{} {:.3f} s", line.empty() ? "" : ", ", name, seconds);
    return line;
}

// How the number of blades was chosen, if the meadow decided; empty otherwise.
std::string amountLine(const bake::Report& report)
{
    if (report.densityClosed <= 0.0 || report.widening > 1.0)
        return {};
    return fmt::format("{:.4g} blades per m² close the meadow's sward; --density, --count or "
                       "--spacing change that",
                       report.densityClosed);
}

// Which slopes bear grass, if their choice rejects roots; empty otherwise.
std::string slopeLine(const bake::Report& report)
{
    const bool rejects = report.rejected[static_cast<std::size_t>(bake::Reject::slope)] > 0;
    if (!report.slopeChosen || !rejects)
        return {};
    return fmt::format("a heightfield bears grass on slopes of {} degrees; --slope 0:180 grows it "
                       "on all",
                       bake::textOf(report.slope));
}

std::string colorLine(const bake::Report& report)
{
    if (!report.maskChosen || !report.colors)
        return {};
    return fmt::format(
        "by its own colours {:.0f} % of the ground is green and {:.0f} % is earth, rock, "
        "sand or water: grass grows on the green (--mask ground:green); --mask none grows it on "
        "all",
        100.0 * report.colors->green, 100.0 * report.colors->bare);
}

void tell(const std::string& name, const bake::Report& report)
{
    for (const std::string& warning : report.warnings)
        log::warn("{}", warning);
    for (const std::string& line : {amountLine(report), slopeLine(report), colorLine(report)})
        if (!line.empty())
            log::info("{}", line);
    log::info("{}", rejectionLine(report));
    log::debug("{}", timingLine(report.timing));
    writeResult(resultLine(name, report) + "\n");
}

std::string topologyLine(const terrain::Topology& topology)
{
    return fmt::format(
        "topology: {} welded vertices ({} across seams), {} components, {} border edges, {} "
        "creases, {} "
        "non-manifold edges, {} non-manifold vertices, {} degenerate and {} duplicate "
        "triangles",
        topology.weldedVertices, topology.seamVertexCount, topology.components,
        topology.borderEdgeCount, topology.creaseEdgeCount, topology.nonManifoldEdgeCount,
        topology.nonManifoldVertexCount, topology.degenerateTriangles, topology.duplicateTriangles);
}

} // namespace sward::apps
