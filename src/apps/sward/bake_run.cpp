#include "apps/sward/bake_run.h"

#include "apps/sward/files/output_files.h"
#include "apps/sward/options/ground_input.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/bake.h"
#include "bake/bake_file.h"
#include "bake/plan/paint_mask.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "core/system/peak_memory.h"
#include "terrain/image/gray_png.h"

#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

namespace sward::apps {
namespace {

void checkOutputs(const BakeRequest& request)
{
    const std::vector<std::string> sources = request.sources();
    const bool writesField = !request.dryRun && !request.output.empty();
    if (writesField)
        checkOutput(request.output, ".sward", sources, request.overwrite);
    if (!request.report.empty())
        checkOutput(request.report, ".json", sources, request.overwrite);
    if (!request.paintMask.empty())
        checkOutput(request.paintMask, ".png", sources, request.overwrite);
    if (writesField && !request.report.empty() && isSameFile(request.report, request.output))
        fail(ErrorKind::usage, "{}: is named both as the field and as the report", request.output);
}

// Bakes and writes or keeps the field, or estimates it. The ground is of no use afterwards.
bake::Report grow(const BakeRequest& request, const BakeRun& run, terrain::GroundMesh&& ground,
                  Diagnostics& diagnostics, Progress& progress)
{
    if (request.dryRun)
        return bake::estimateBake(ground, request.settings, request.threads, diagnostics, progress);
    if (!request.output.empty())
        return bake::bakeIntoFile(std::move(ground), request.settings, request.threads,
                                  request.output, request.overwrite, diagnostics, progress);
    bake::BakeResult result =
        bake::bakeField(ground, request.settings, request.threads, diagnostics, progress);
    if (run.kept != nullptr)
        *run.kept = std::move(result.field);
    return std::move(result.report);
}

// The painted density as a PNG file.
std::vector<std::byte> paintMaskOf(const BakeRequest& request, const terrain::GroundMesh& ground,
                                   Diagnostics& diagnostics, Progress& progress)
{
    const bake::PaintMask mask = bake::paintMask(ground, request.settings, request.paintMaskSize,
                                                 request.threads, diagnostics, progress);
    return terrain::grayPng(mask.size, mask.size, mask.values);
}

void writeImage(const BakeRequest& request, const std::vector<std::byte>& png)
{
    AtomicFile file(request.paintMask, request.overwrite);
    file.write(png);
    file.commit();
}

} // namespace

bake::Report runBake(BakeRequest& request, const BakeRun& run, Diagnostics& diagnostics,
                     Progress& progress)
{
    if (request.dryRun && request.settings.seeds == bake::SeedUse::always)
        fail(ErrorKind::usage, "--dry-run estimates no seeds; leave --seeds out");
    checkOutputs(request);

    // Load the ground.
    Stopwatch total;
    Stopwatch watch;
    terrain::GroundMesh ground = loadGround(request, diagnostics);
    checkOutputs(request); // against all files that the ground names
    const double loading = watch.lap();
    if (run.tellsTopology)
        log::debug("{}", topologyLine(terrain::analyse(ground)));
    const double connecting = watch.lap();

    // Bake.
    std::vector<std::byte> paintMask;
    if (!request.paintMask.empty())
        paintMask = paintMaskOf(request, ground, diagnostics, progress);
    bake::Report report = grow(request, run, std::move(ground), diagnostics, progress);
    if (!request.paintMask.empty())
        writeImage(request, paintMask);

    // Fill in values known only here.
    report.slopeChosen = request.choosesSlope;
    report.maskChosen = request.choosesMask;
    report.input.path = fmt::format("{}", fmt::join(request.inputs, ", "));
    report.timing.load = loading;
    report.timing.topology += connecting;
    report.timing.total = total.lap();
    report.timing.totalBusy = processorSeconds();
    report.peakMemory = peakMemory();
    report.warnings = diagnostics.warnings();
    if (!request.report.empty())
        writeTextFile(request.report, bake::toJson(report), request.overwrite);
    return report;
}

} // namespace sward::apps
