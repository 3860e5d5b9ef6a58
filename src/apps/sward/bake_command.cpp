#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/effective_settings.h"
#include "apps/sward/options/ground_input.h"
#include "apps/sward/subcommand.h"
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
    if (!request.dryRun)
        checkOutput(request.output, ".sward", sources, request.overwrite);
    if (!request.report.empty())
        checkOutput(request.report, ".json", sources, request.overwrite);
    if (!request.paintMask.empty())
        checkOutput(request.paintMask, ".png", sources, request.overwrite);
    if (!request.dryRun && !request.report.empty() && isSameFile(request.report, request.output))
        fail(ErrorKind::usage, "{}: is named both as the field and as the report", request.output);
}

// Bakes and writes the field, or estimates it. The ground is of no use afterwards. The caller fills
// in load time and the rest of the report.
bake::Report grow(const BakeRequest& request, terrain::GroundMesh&& ground,
                  Diagnostics& diagnostics, Progress& progress)
{
    if (request.dryRun)
        return bake::estimateBake(ground, request.settings, request.threads, diagnostics, progress);

    return bake::bakeIntoFile(std::move(ground), request.settings, request.threads, request.output,
                              request.overwrite, diagnostics, progress);
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

class Bake : public Subcommand {
public:
    explicit Bake(CLI::App& program)
        : Subcommand(
              program, "bake", "Grow grass on ground and write a field file",
              "sward bake hills -o meadow.sward --density 200 --slope 0:45\n\n"
              "A range MIN:MAX~SOFT keeps roots inside of it and fades out over SOFT outside.\n"
              "M~SOFT keeps no root up to M and every root from M + SOFT on.")
    {
        options_.add(app());
    }

    int run() const override
    {
        options_.log.apply();
        BakeRequest request = options_.request();
        if (request.dryRun && request.settings.seeds == bake::SeedUse::always)
            fail(ErrorKind::usage, "--dry-run estimates no seeds; leave --seeds out");
        if (options_.printConfig) {
            writeResult(effectiveSettings(request) + "\n");
            return 0;
        }
        checkOutputs(request);

        // Load the ground.
        Stopwatch total;
        Stopwatch watch;
        Diagnostics diagnostics;
        terrain::GroundMesh ground = loadGround(request, diagnostics);
        checkOutputs(request); // against all files that the ground names
        const double loading = watch.lap();
        // Compute the topology line only when verbose, because it takes time.
        if (options_.log.verbose)
            log::debug("{}", topologyLine(terrain::analyse(ground)));
        const double connecting = watch.lap();

        // Bake with a progress bar; a signal cancels it.
        ProgressBar bar(options_.log.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        std::vector<std::byte> paintMask;
        if (!request.paintMask.empty())
            paintMask = paintMaskOf(request, ground, diagnostics, progress);
        bake::Report report = grow(request, std::move(ground), diagnostics, progress);
        if (!request.paintMask.empty())
            writeImage(request, paintMask);
        bar.clear();

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
        tell(request.dryRun ? "dry run" : request.output, report);
        return 0;
    }

private:
    BakeOptions options_;
};

} // namespace

std::unique_ptr<Subcommand> addBake(CLI::App& program)
{
    return std::make_unique<Bake>(program);
}

} // namespace sward::apps
