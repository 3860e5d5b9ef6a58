#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/temporary_folder.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/sward/edit_requests.h"
#include "apps/sward/files/line_input.h"
#include "apps/sward/options/bake_options.h"
#include "apps/sward/options/ground_input.h"
#include "apps/sward/subcommand.h"
#include "bake/patches/cell_tree.h"
#include "bake/session/session.h"
#include "bake/tiles/bake_tile.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/log.h"
#include "core/process/arriving_bytes.h"
#include "field/read.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> speciesNames(const bake::BakeSettings& settings)
{
    std::vector<std::string> names;
    for (const bake::SpeciesTraits& species : settings.meadow.species)
        names.push_back(species.name);
    return names;
}

// Options whose values a field holds.
constexpr const char* settingsInFields[] = {
    "--density",     "--count",     "--spacing",  "--sampling",    "--budget",
    "--blade-scale", "--seed",      "--sides",    "--ground-up",   "--slope",
    "--altitude",    "--curvature", "--border",   "--above-water", "--sky",
    "--min-island",  "--clearance", "--sky-rays", "--ray-length",  "--align"};

class Edit : public Subcommand {
public:
    explicit Edit(CLI::App& program)
        : Subcommand(program, "edit",
                     "Keep a bake open and paint on it, by JSON lines from standard input",
                     "sward edit terrain.glb --density 100 --field meadow.sward")
    {
        options_.add(app());
        options_.needsOutput = false;
        for (const char* name : {"--output", "--report", "--dry-run", "--force", "--print-config",
                                 "--paint-mask", "--paint-mask-size", "--seeds"})
            app().remove_option(app().get_option(name));
        app()
            .add_option("--field", field_,
                        "Field that was baked of this ground with these options and strokes: its "
                        "blades are used")
            ->type_name("FIELD.sward")
            ->group("Run");
        app()
            .add_flag(
                "--as-baked", asBaked_,
                "Take density, meadow and all other settings of the bake from --field; "
                "images of masks, a meadow with such, excluded areas and strokes are still named")
            ->needs(app().get_option("--field"))
            ->group("Run");
        app()
            .add_option("--deltas", deltas_,
                        "Existing folder for files with changes; a temporary one if left out")
            ->type_name("DIR")
            ->group("Run");
    }

    int run() const override
    {
        options_.log.apply();
        if (!deltas_.empty() && !fs::is_directory(deltas_))
            fail(ErrorKind::io, "{}: is no folder", deltas_);
        std::optional<field::MappedField> baked;
        std::optional<field::FieldView> view;
        if (!field_.empty())
            view = baked.emplace(field::readField(field_)).view();
        if (asBaked_)
            requireNoneOf(settingsInFields);
        BakeRequest request =
            asBaked_ ? options_.requestAsBaked(*view->provenance, field_) : options_.request();

        // Who names a field with seeds can sow.
        const bool isSeeded = view && view->seeds != nullptr;
        request.settings.seeds = isSeeded ? bake::SeedUse::always : bake::SeedUse::never;

        Diagnostics diagnostics;
        const terrain::GroundMesh ground = loadGround(request, diagnostics);

        ProgressBar bar(options_.log.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        bake::Session session(ground, request.settings, request.threads, diagnostics, progress,
                              view ? &*view : nullptr);
        baked.reset();
        bar.clear();
        std::optional<TemporaryFolder> own;
        const fs::path deltas =
            deltas_.empty() ? own.emplace("sward-edit").path() : fs::absolute(deltas_);
        const auto load = [&](Diagnostics& warnings) {
            BakeRequest again = request;
            again.moveStrokes = 0.0; // the session's are others, and stay
            return loadGround(again, warnings);
        };
        EditRequests requests(session, speciesNames(request.settings), deltas, request.sources(),
                              request.settings.maxBlades, load);
        tellReady(session, ground, request, diagnostics);

        LineInput input(standardInput, longestRequest);
        while (!requests.hasEnded()) {
            const std::optional<LineInput::Line> line = input.next();
            if (!line)
                break;
            const std::string answer = line->isTooLong ? EditRequests::answerToLongLine()
                                                       : requests.answer(line->text, progress);
            bar.clear();
            writeResult(answer + "\n");
        }
        throwIfInterrupted("edit");
        return 0;
    }

private:
    // Not CLI11's excludes(): the help of each option would tell it.
    void requireNoneOf(std::span<const char* const> names) const
    {
        for (const char* name : names)
            if (app().get_option(name)->count() > 0)
                fail(ErrorKind::usage, "{}: --as-baked takes it from --field", name);
    }

    // The first line: that the session is ready, and what of.
    static void tellReady(const bake::Session& session, const terrain::GroundMesh& ground,
                          const BakeRequest& request, const Diagnostics& diagnostics)
    {
        const glm::dvec3& origin = ground.origin;
        const nlohmann::json ready = {{"format", "sward edit 1"},
                                      {"origin", {origin.x, origin.y, origin.z}},
                                      {"blades", session.bladeCount()},
                                      {"cells", session.cells().size()},
                                      {"strokes", session.strokes().list.size()},
                                      {"species", speciesNames(request.settings)},
                                      {"scale", session.plan().plan.scale},
                                      {"reused", session.hasReused()},
                                      {"seeds", session.hasSeeds()},
                                      {"lost", lostStrokes(session.contacts(), 0)},
                                      {"warnings", diagnostics.warnings()}};
        writeResult(jsonText(ready) + "\n");
    }

    BakeOptions options_;
    std::string field_;
    bool asBaked_ = false;
    std::string deltas_;
};

} // namespace

std::unique_ptr<Subcommand> addEdit(CLI::App& program)
{
    return std::make_unique<Edit>(program);
}

} // namespace sward::apps
