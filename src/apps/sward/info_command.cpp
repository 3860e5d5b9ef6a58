#include "apps/common/field_input.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/info_text.h"
#include "field/read.h"

#include <CLI/CLI.hpp>

#include <optional>

namespace sward::apps {
namespace {

class Info : public Subcommand {
public:
    explicit Info(CLI::App& program)
        : Subcommand(program, "info", "Print what a field file contains",
                     "sward info meadow.sward --json")
    {
        app().add_option("FILE", file_, "Field file")->type_name("")->required();
        app().add_flag("--json", json_, "Print everything as JSON, with all settings of the bake");
        app().add_flag("--histogram", histogram_,
                       "Print histograms of heights, widths, slopes, distances and densities too");
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        requireField(file_);
        const field::MappedField field = field::readField(file_);
        std::optional<field::Distributions> all;
        if (histogram_)
            all = field::distributionsOf(field.view());
        const field::Distributions* const shown = all ? &*all : nullptr;
        writeResult(json_ ? infoJson(file_, field.view(), field.fileBytes(), shown) + "\n"
                          : infoText(file_, field.view(), field.fileBytes(), shown));
        return 0;
    }

private:
    std::string file_;
    bool json_ = false;
    bool histogram_ = false;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addInfo(CLI::App& program)
{
    return std::make_unique<Info>(program);
}

} // namespace sward::apps
