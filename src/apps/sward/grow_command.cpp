#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "bake/seeds/grow_field.h"
#include "field/inspect.h"
#include "field/read.h"
#include "field/write.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdint>
#include <string>

namespace sward::apps {
namespace {

constexpr int maxThreadsOfGrowth = 1024;

class Grow : public Subcommand {
public:
    explicit Grow(CLI::App& program)
        : Subcommand(program, "grow", "Grow the blades of a field's seeds",
                     "sward grow terrain.sward --around 120,8,-40,25 -o near.sward\n\n"
                     "The field of a region holds all its blades, whatever grows outside. Regions "
                     "that\ndivide the ground divide its blades.")
    {
        app().add_option("FILE", file_, "Field file with seeds")->type_name("")->required();
        app()
            .add_option("-o,--output", output_, "Field file to write")
            ->type_name("OUT.sward")
            ->required();
        growth_.add(app());
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
        const bake::Growth growth = growth_.growthIn(view.origin);
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
    std::string file_;
    std::string output_;
    int threads_ = 0;
    bool overwrite_ = false;
    GrowthOptions growth_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addGrow(CLI::App& program)
{
    return std::make_unique<Grow>(program);
}

} // namespace sward::apps
