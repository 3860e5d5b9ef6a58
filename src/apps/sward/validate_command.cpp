#include "apps/common/field_input.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward/subcommand.h"
#include "field/read.h"
#include "field/seeds/seeds.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace sward::apps {
namespace {

class Validate : public Subcommand {
public:
    explicit Validate(CLI::App& program)
        : Subcommand(program, "validate", "Verify every byte of a field file",
                     "sward validate meadow.sward")
    {
        app().add_option("FILE", file_, "Field file")->type_name("")->required();
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        // Reading validates, but for the insides of cells of seeds: it throws at the first error.
        requireField(file_);
        const field::MappedField field = field::readField(file_);
        std::string seedsToo;
        if (const field::SeedsView* const seeds = field.view().seeds) {
            for (std::size_t i = 0; i < seeds->cells.size(); ++i)
                field::readSeedCell(*seeds, i, file_);
            seedsToo = fmt::format(", seeds in {} cells", seeds->cells.size());
        }
        writeResult(fmt::format("{}: valid, {} blades in {} patches{}\n", file_,
                                field::rootedBlades(field.view()), field.view().patches.size(),
                                seedsToo));
        return 0;
    }

private:
    std::string file_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addValidate(CLI::App& program)
{
    return std::make_unique<Validate>(program);
}

} // namespace sward::apps
