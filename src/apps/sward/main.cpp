// sward: grows grass on ground and keeps it in a field file.

#include "apps/common/command_line.h"
#include "apps/common/interrupt.h"
#include "apps/common/program.h"
#include "apps/sward/subcommand.h"
#include "core/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdio>

namespace {

constexpr const char* description =
    "Grows grass on any ground: places blades on a mesh and writes them into a field file.";

constexpr const char* exitCodes =
    "Exit codes: 0 done, 1 wrong usage, 2 cannot read or write, 3 invalid input,\n"
    "4 failure while running, 5 unsupported, 7 difference found, 130 interrupted.\n"
    "'sward COMMAND --help' explains a command.";

int run(int argc, char** argv)
{
    using namespace sward::apps;

    CLI::App program{description};
    prepareApp(program, "sward");
    const std::unique_ptr<Subcommand> commands[] = {
        addBake(program),   addInfo(program),    addValidate(program), addCompare(program),
        addExport(program), addTerrain(program), addPlan(program),     addTile(program),
        addMerge(program),  addEdit(program),    addTrace(program),    addGrow(program),
        addLidar(program)};
    program.footer(exitCodes);
    program.require_subcommand(0, 1);
    if (const std::optional<int> done = parseCommandLine(program, argc, argv))
        return *done;

    for (const std::unique_ptr<Subcommand>& command : commands)
        if (command->isChosen())
            return command->run();

    // No command: print the help.
    fmt::print(stderr, "{}", program.help());
    return static_cast<int>(sward::ErrorKind::usage);
}

} // namespace

int main(int argc, char** argv)
{
    return sward::apps::runProgram("sward", [&] {
        sward::apps::boundInterrupts();
        return run(argc, argv);
    });
}
