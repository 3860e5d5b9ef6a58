#include "apps/common/output.h"
#include "apps/sward/info_text.h"
#include "apps/sward/subcommand.h"
#include "field/read.h"

#include <CLI/CLI.hpp>

namespace sward::apps {
namespace {

class Info : public Subcommand {
public:
    explicit Info(CLI::App& program)
        : Subcommand(program, "info", "Say what is in a field file",
                     "sward info meadow.sward --json")
    {
        app().add_option("FILE", file_, "Field file")->type_name("")->required();
        app().add_flag("--json", json_, "As JSON, for programs");
    }

    int run() const override
    {
        const field::MappedField field = field::readField(file_);
        writeResult(json_ ? infoJson(file_, field.view(), field.fileBytes()) + "\n"
                          : infoText(file_, field.view(), field.fileBytes()));
        return 0;
    }

private:
    std::string file_;
    bool json_ = false;
};

} // namespace

std::unique_ptr<Subcommand> addInfo(CLI::App& program)
{
    return std::make_unique<Info>(program);
}

} // namespace sward::apps
