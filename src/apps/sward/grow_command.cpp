#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/parse_text.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/seeds/grow_field.h"
#include "core/error.h"
#include "field/inspect.h"
#include "field/read.h"
#include "field/write.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sward::apps {
namespace {

constexpr int maxThreadsOfGrowth = 1024;
constexpr double widestPlace = 1e12; // [m]

class Grow : public Subcommand {
public:
    explicit Grow(CLI::App& program)
        : Subcommand(program, "grow", "Grow the blades of a field's seeds",
                     "sward grow terrain.sward --around 120,8,-40,25 -o near.sward\n\n"
                     "The field of a region holds all its blades, whatever grows outside. Regions "
                     "that\ndivide the ground divide its blades.")
    {
        growth_.maxBlades = 200'000'000;
        app().add_option("FILE", file_, "Field file with seeds")->type_name("")->required();
        app()
            .add_option("-o,--output", output_, "Field file to write")
            ->type_name("OUT.sward")
            ->required();
        CLI::Option* const region =
            app()
                .add_option("--region", region_,
                            "Only blades whose roots lie from X0 up to X1 and from Z0 up to Z1, in "
                            "metres of the world")
                ->type_name("X0:X1,Z0:Z1")
                ->default_str("everywhere");
        app()
            .add_option("--around", around_,
                        "Only blades whose roots lie within R metres of a place of the world")
            ->type_name("X,Y,Z,R")
            ->default_str("everywhere")
            ->excludes(region);
        app()
            .add_option("--share", share_,
                        "Only blades of ranks below this share, 0 to 1: evenly spread everywhere")
            ->type_name("S")
            ->check(CLI::Range(0.0, 1.0).description(""))
            ->capture_default_str();
        app()
            .add_option("--max-blades", growth_.maxBlades,
                        "Limit on the number of blades, ribbons included; more are an error")
            ->type_name("N")
            ->capture_default_str();
        app()
            .add_option("--threads", threads_,
                        "Threads, 0 to 1024; 0: one for each CPU; the field does not depend on it")
            ->type_name("N")
            ->check(CLI::Range(0, maxThreadsOfGrowth).description(""))
            ->capture_default_str();
        app().add_flag("--force", overwrite_, "Overwrite an existing file");
        log_.add(app());
        log_.addBar(app());
    }

    int run() const override
    {
        log_.apply();
        checkOutput(output_, ".sward", {file_}, overwrite_);
        requireField(file_);
        const field::MappedField mapped = field::readField(file_);
        const field::FieldView view = mapped.view();
        bake::Growth growth = growth_;
        growth.region = regionIn(view.origin);
        ProgressBar bar(log_.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        const field::Field grown = bake::growField(view, growth, threads_, file_, progress);
        const std::uint64_t bytes = field::writeField(grown, output_, overwrite_);
        bar.clear();
        writeResult(fmt::format("{}: {} blades, {}\n", output_,
                                field::rootedBlades(field::viewOf(grown)), sizeText(bytes)));
        return 0;
    }

private:
    // The region, relative to the field's origin.
    field::SowRegion regionIn(const glm::dvec3& origin) const
    {
        field::SowRegion region;
        region.share = static_cast<float>(share_);
        if (!region_.empty()) {
            const std::vector<std::string_view> parts = splitText(region_, ',');
            if (parts.size() != 2)
                fail(ErrorKind::usage, "--region is \"{}\"; expected X0:X1,Z0:Z1", region_);
            const auto [lowX, highX] = parseRange("--region", parts[0]);
            const auto [lowZ, highZ] = parseRange("--region", parts[1]);
            region.low.x = lowX - origin.x;
            region.high.x = highX - origin.x;
            region.low.z = lowZ - origin.z;
            region.high.z = highZ - origin.z;
        }
        if (!around_.empty()) {
            const std::vector<std::string_view> parts = splitText(around_, ',');
            if (parts.size() != 4)
                fail(ErrorKind::usage, "--around is \"{}\"; expected X,Y,Z,R", around_);
            glm::dvec3 centre;
            for (glm::length_t axis = 0; axis < 3; ++axis)
                centre[axis] =
                    parseNumber("--around", parts[std::size_t(axis)], -widestPlace, widestPlace);
            region.centre = centre - origin;
            region.radius = parseNumber("--around", parts[3], 0.0, widestPlace);
        }
        return region;
    }

    std::string file_;
    std::string output_;
    std::string region_;
    std::string around_;
    double share_ = 1.0;
    int threads_ = 0;
    bool overwrite_ = false;
    bake::Growth growth_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addGrow(CLI::App& program)
{
    return std::make_unique<Grow>(program);
}

} // namespace sward::apps
