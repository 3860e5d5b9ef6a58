#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/beam_file.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/files/point_file.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/options/lidar_options.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/settings/threads.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "field/read.h"
#include "shaders/shared/blade.h"
#include "trace/blade_poses.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace sward::apps {
namespace {

class Lidar : public Subcommand {
public:
    explicit Lidar(CLI::App& program)
        : Subcommand(
              program, "lidar",
              "Measure a field as a range sensor does: points with the blade that each pulse meets",
              "sward lidar meadow.sward -o points.npy --scanner 0,0 --above 1.8 --rings 64")
    {
        options_.add(app());
        growth_.add(app(), "Of a field with seeds");
        log_.add(app());
        log_.addBar(app());
    }

    int run() const override
    {
        log_.apply();
        // Check before any work.
        options_.check();
        requirePointName(options_.output);
        std::vector<std::string> sources{options_.field};
        for (const std::string& source : {options_.poses, options_.beams})
            if (!source.empty())
                sources.push_back(source);
        checkOutput(options_.output, std::filesystem::path(options_.output).extension().string(),
                    sources, options_.overwrite);

        requireField(options_.field);
        const field::MappedField file = field::readField(options_.field);
        ProgressBar bar(log_.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        const std::optional<field::Field> grown =
            growth_.grownOf(file.view(), options_.threads, options_.field, "measured", progress);
        const field::FieldView view = grown ? field::viewOf(*grown) : file.view();
        bake::withThreads(bake::threadCount(options_.threads),
                          [&] { measure(view, bar, progress); });
        return 0;
    }

private:
    void measure(const field::FieldView& view, ProgressBar& bar, Progress& progress) const
    {
        Stopwatch watch;
        progress.begin("scene", 1);
        const std::vector<trace::BladePose> poses = options_.poses.empty()
                                                        ? trace::restingPoses(view)
                                                        : trace::readPoses(view, options_.poses);
        std::vector<std::uint8_t> species(view.blades.size());
        for (const shared::Patch& patch : view.patches)
            for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i)
                species[i] =
                    static_cast<std::uint8_t>(shared::unpackBlade(view.blades[i], patch).species);
        const trace::LidarSettings settings = options_.settingsFor(view);
        const trace::Beams beams =
            options_.beams.empty()
                ? options_.patternOver(view, trace::RayScene(trace::groundOf(view)))
                : readBeams(options_.beams);
        const trace::RayScene scene(trace::surfacesOf(view, poses, {}));
        log::debug("scene: {} quads, {} triangles of ground, {:.1f} s",
                   scene.surfaces().quads.size(), scene.surfaces().groundTriangles.size(),
                   watch.lap());

        PointFile points(options_.output, view, species, options_.overwrite);
        progress.begin("measuring", beams.count);
        const trace::LidarCounts counts = trace::scan(
            scene, view.origin, species, beams, settings,
            [&](std::span<const trace::LidarReturn> some) { points.add(some); }, progress);
        const double seconds = watch.lap();
        points.commit();
        bar.clear();
        const double rays = std::max(double(counts.rays), 1.0);
        writeResult(fmt::format("{}: {} points of {} pulses, {}; {:.1f} % of the rays met the "
                                "ground, {:.1f} % nothing; {:.2f} million pulses a second\n",
                                options_.output, counts.returns, counts.beams,
                                sizeText(std::filesystem::file_size(options_.output)),
                                100.0 * double(counts.groundRays) / rays,
                                100.0 * double(counts.freeRays) / rays,
                                1e-6 * double(counts.beams) / std::max(seconds, 1e-9)));
    }

    LidarOptions options_;
    GrowthOptions growth_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addLidar(CLI::App& program)
{
    return std::make_unique<Lidar>(program);
}

} // namespace sward::apps
