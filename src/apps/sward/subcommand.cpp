#include "apps/sward/subcommand.h"

#include <CLI/CLI.hpp>

namespace sward::apps {

Subcommand::Subcommand(CLI::App& program, const std::string& name, const std::string& description,
                       const std::string& example)
    : app_(program.add_subcommand(name, description))
{
    app_->footer("Example:\n  " + example);
}

bool Subcommand::isChosen() const
{
    return app_->parsed();
}

} // namespace sward::apps
