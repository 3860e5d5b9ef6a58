#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace sward::apps {

/// One subcommand with its options. The program owns all of them; the chosen one runs.
class Subcommand {
public:
    /// Adds the subcommand `name` to `program`; `example` is shown at the end of its help.
    Subcommand(CLI::App& program, const std::string& name, const std::string& description,
               const std::string& example);
    Subcommand(const Subcommand&) = delete;
    Subcommand& operator=(const Subcommand&) = delete;
    virtual ~Subcommand() = default;

    bool isChosen() const;

    /// Runs the command and returns the exit code. Throws Error.
    virtual int run() const = 0;

protected:
    CLI::App& app() { return *app_; }
    const CLI::App& app() const { return *app_; }

private:
    CLI::App* app_;
};

std::unique_ptr<Subcommand> addBake(CLI::App& program);
std::unique_ptr<Subcommand> addGrow(CLI::App& program);
std::unique_ptr<Subcommand> addInfo(CLI::App& program);
std::unique_ptr<Subcommand> addValidate(CLI::App& program);
std::unique_ptr<Subcommand> addCompare(CLI::App& program);
std::unique_ptr<Subcommand> addExport(CLI::App& program);
std::unique_ptr<Subcommand> addTerrain(CLI::App& program);
std::unique_ptr<Subcommand> addPlan(CLI::App& program);
std::unique_ptr<Subcommand> addTile(CLI::App& program);
std::unique_ptr<Subcommand> addMerge(CLI::App& program);
std::unique_ptr<Subcommand> addEdit(CLI::App& program);
std::unique_ptr<Subcommand> addLidar(CLI::App& program);
std::unique_ptr<Subcommand> addTrace(CLI::App& program);

} // namespace sward::apps
