#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/lidar/beam_file.h"
#include "apps/lidar/lidar_options.h"
#include "apps/lidar/point_file.h"
#include "apps/lidar/point_writer.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/subcommand.h"
#include "bake/settings/threads.h"
#include "core/log.h"
#include "core/stopwatch.h"
#include "field/poses/blade_poses.h"
#include "field/read.h"
#include "trace/lidar.h"
#include "trace/ray_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

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
        options_.add(app(), true, "at rest, without wind");
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
        const auto threads = static_cast<unsigned>(bake::threadCount(options_.threads));
        const std::vector<field::BladePose> poses = options_.poses.empty()
                                                        ? field::restingPoses(view, threads)
                                                        : field::readPoses(view, options_.poses);
        const std::vector<std::uint8_t> species = speciesOfBlades(view);
        const lidar::LidarSettings settings = options_.settingsFor(view);
        const lidar::Beams beams =
            options_.beamsOver(view, [&](double x, double z) { return highestGround(view, x, z); });
        const trace::RayScene scene(trace::surfacesOf(view, poses, {}));
        log::debug("scene: {} quads, {} triangles of ground, {:.1f} s",
                   scene.surfaces().quads.size(), scene.surfaces().groundTriangles.size(),
                   watch.lap());

        PointFile points(options_.output, view, species, options_.overwrite);
        PointWriter writer(points, threads);
        progress.begin("measuring", beams.count);
        const lidar::LidarCounts counts = trace::scan(
            scene, view.origin, species, beams, settings,
            [&](lidar::ReturnParts some) { writer.add(std::move(some)); }, progress);
        writer.finish();
        const double seconds = watch.lap();
        points.commit();
        bar.clear();
        writeResult(fmt::format("{}; {:.2f} million pulses a second\n",
                                countsText(options_.output, counts),
                                1e-6 * double(counts.beams) / std::max(seconds, 1e-9)));
    }

    // Its Y in the world.
    static std::optional<double> highestGround(const field::FieldView& view, double x, double z)
    {
        const float top = view.bounds().high.y + 1.0f;
        const glm::vec3 from(static_cast<float>(x - view.origin.x), top,
                             static_cast<float>(z - view.origin.z));
        trace::RayHit hit;
        if (!trace::RayScene(trace::groundOf(view)).meets(from, {0.0f, -1.0f, 0.0f}, hit))
            return std::nullopt;
        return view.origin.y + double(top) - double(hit.distance);
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
