#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/bake_run.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/effective_settings.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"

namespace sward::apps {
namespace {

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
        if (options_.printConfig) {
            writeResult(effectiveSettings(request) + "\n");
            return 0;
        }

        // Bake with a progress bar; a signal cancels it.
        Diagnostics diagnostics;
        ProgressBar bar(options_.log.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        const bake::Report report =
            runBake(request, {.tellsTopology = options_.log.verbose}, diagnostics, progress);
        bar.clear();
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
