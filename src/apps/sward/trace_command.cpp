#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/files/traced_picture.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/options/trace_options.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/settings/threads.h"
#include "core/log.h"
#include "core/lower_case.h"
#include "core/stopwatch.h"
#include "field/poses/blade_poses.h"
#include "field/read.h"
#include "trace/tracer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace sward::apps {
namespace {

class Trace : public Subcommand {
public:
    explicit Trace(CLI::App& program)
        : Subcommand(program, "trace",
                     "Trace paths of light over a field: the reference for the viewer's pictures",
                     "sward trace meadow.sward -o truth.exr --samples 256 --layers all")
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
        const bool isPng =
            lowerCase(std::filesystem::path(options_.output).extension().string()) == ".png";
        options_.check();
        std::vector<std::string> sources{options_.field};
        if (!options_.poses.empty())
            sources.push_back(options_.poses);
        checkOutput(options_.output, isPng ? ".png" : ".exr", sources, options_.overwrite);

        requireField(options_.field);
        const field::MappedField file = field::readField(options_.field);
        ProgressBar bar(log_.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        const std::optional<field::Field> grown =
            growth_.grownOf(file.view(), options_.threads, options_.field, "traced", progress);
        const field::FieldView view = grown ? field::viewOf(*grown) : file.view();
        bake::withThreads(bake::threadCount(options_.threads),
                          [&] { trace(view, isPng, bar, progress); });
        return 0;
    }

private:
    void trace(const field::FieldView& view, bool isPng, ProgressBar& bar, Progress& progress) const
    {
        Stopwatch watch;
        const double processorBefore = processorSeconds();
        progress.begin("scene", 1);
        const auto threads = static_cast<unsigned>(bake::threadCount(options_.threads));
        const std::vector<field::BladePose> poses =
            options_.poses.empty() ? field::restingPoses(view, threads)
                                   : field::readPoses(view, options_.poses);
        const trace::Light light = options_.lightOver(view);
        const trace::TraceSettings& settings = options_.settings();
        const trace::Camera camera =
            options_.cameraOf(view, trace::RayScene(trace::groundOf(view)), light);
        const trace::Lens lens(camera, view.origin, settings.size);
        trace::SurfaceSettings exactness = options_.surfaces;
        exactness.seen = {.eye = lens.eye(), .pixel = lens.pixel()};
        const trace::RayScene scene(trace::surfacesOf(view, poses, exactness));
        trace::Tracer tracer(scene, camera, view.origin, light, settings);
        log::debug("scene: {} quads, {} triangles of ground, {:.1f} s",
                   scene.surfaces().quads.size(), scene.surfaces().groundTriangles.size(),
                   watch.lap());

        progress.begin("tracing", std::uint64_t(settings.size.y) * options_.samples);
        const double processorAtStart = processorSeconds();
        std::uint32_t next = options_.progressive ? 1 : options_.samples;
        bool overwrite = options_.overwrite;
        while (tracer.samples() < options_.samples) {
            next = std::min(next, options_.samples);
            // In passes, so that a row never takes long and an interrupt is noticed.
            while (tracer.samples() < next)
                tracer.add(std::min(next - tracer.samples(), samplesAtOnce), progress);
            write(tracer.layers(), settings.size, isPng, overwrite);
            overwrite = true;
            next = next > options_.samples / 4 ? options_.samples : 4 * next;
        }
        bar.clear();
        const double tracing = processorSeconds() - processorAtStart;
        const trace::Tracer::Counts counts = tracer.counts();
        log::debug("{} rays, {:.2f} of each path", counts.rays,
                   double(counts.rays) / double(counts.paths));
        writeResult(fmt::format("{}: {}x{} pixels, {} samples, {}; {:.1f} s of processor time, "
                                "{:.2f} million paths and "
                                "{:.2f} million rays in each\n",
                                options_.output, settings.size.x, settings.size.y, tracer.samples(),
                                sizeText(std::filesystem::file_size(options_.output)),
                                processorSeconds() - processorBefore,
                                1e-6 * double(counts.paths) / std::max(tracing, 1e-9),
                                1e-6 * double(counts.rays) / std::max(tracing, 1e-9)));
    }

    void write(const trace::Layers& picture, glm::uvec2 size, bool isPng, bool overwrite) const
    {
        if (isPng)
            writeTracedPng(picture, size, options_.exposure.value_or(exposureOf(picture)),
                           options_.output, overwrite);
        else
            writeTracedExr(picture, size, options_.layers, options_.output, overwrite);
    }

    static constexpr std::uint32_t samplesAtOnce = 16;

    TraceOptions options_;
    GrowthOptions growth_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addTrace(CLI::App& program)
{
    return std::make_unique<Trace>(program);
}

} // namespace sward::apps
