#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "core/diagnostics.h"
#include "core/log.h"
#include "terrain/gltf/export.h"
#include "terrain/load.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>

namespace sward::apps {
namespace {

class Terrain : public Subcommand {
public:
    explicit Terrain(CLI::App& program)
        : Subcommand(program, "terrain", "Write a built-in ground, or that of a recipe, as .glb",
                     "sward terrain sphere -o sphere.glb")
    {
        app()
            .add_option("RECIPE", input_,
                        "Recipe (.json), or a built-in: plane sphere hills dunes torus arch")
            ->type_name("")
            ->required();
        app()
            .add_option("-o,--output", output_, "Mesh file to write")
            ->type_name("OUT.glb")
            ->required();
        app().add_flag("--force", overwrite_, "Overwrite an existing file");
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        checkOutput(output_, ".glb", {input_}, overwrite_);
        Diagnostics diagnostics;
        const terrain::GroundMesh mesh = terrain::load(input_, {}, diagnostics);
        checkOutput(output_, ".glb", {}, overwrite_); // against all files that the ground names
        terrain::exportGltf(mesh, output_, overwrite_);
        for (const std::string& warning : diagnostics.warnings())
            log::warn("{}", warning);
        writeResult(fmt::format("{}: {} triangles, {}\n", output_, mesh.triangles.size(),
                                sizeText(std::filesystem::file_size(output_))));
        return 0;
    }

private:
    std::string input_;
    std::string output_;
    bool overwrite_ = false;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addTerrain(CLI::App& program)
{
    return std::make_unique<Terrain>(program);
}

} // namespace sward::apps
