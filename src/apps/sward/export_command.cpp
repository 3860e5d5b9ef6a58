#include "apps/common/field_input.h"
#include "apps/common/interrupt.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/common/terminal/progress_bar.h"
#include "apps/common/version.h"
#include "apps/sward/files/new_output_folder.h"
#include "apps/sward/files/output_files.h"
#include "apps/sward/files/poster.h"
#include "apps/sward/options/earth_options.h"
#include "apps/sward/options/growth_options.h"
#include "apps/sward/subcommand.h"
#include "apps/sward/text/bake_summary.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/mapped_file.h"
#include "field/read.h"
#include "field/write.h"
#include "interchange/formats.h"
#include "interchange/page.h"
#include "interchange/tiles/tileset.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace sward::apps {
namespace {

/// Whether an output is the folder of a page: its name ends in a slash.
bool isPage(const std::string& output)
{
    return !output.empty() && (output.back() == '/' || output.back() == '\\');
}

/// Refuses a folder that holds something, unless it may be replaced.
void checkPage(const std::filesystem::path& folder, bool overwrite)
{
    std::error_code ignored;
    const std::filesystem::path place = folder.has_filename() ? folder : folder.parent_path();
    if (!std::filesystem::exists(place, ignored)) {
        requireWritable(place, overwrite);
        return;
    }
    if (!std::filesystem::is_directory(place, ignored))
        fail(ErrorKind::io, "{}: exists and is no folder", place.string());
    if (!overwrite && !std::filesystem::is_empty(folder, ignored))
        fail(ErrorKind::io, "{}: the folder is not empty; --force writes the page into it",
             folder.string());
}

// The file by which a folder of tiles is known.
constexpr const char* tilesMark = "tileset.json";

bool liesIn(const std::filesystem::path& file, const std::filesystem::path& folder)
{
    std::error_code ignored;
    const std::filesystem::path inside =
        std::filesystem::weakly_canonical(file, ignored)
            .lexically_relative(std::filesystem::weakly_canonical(folder / "", ignored));
    return !inside.empty() && *inside.begin() != "..";
}

class Export : public Subcommand {
public:
    explicit Export(CLI::App& program)
        : Subcommand(program, "export", "Convert a field file for other programs",
                     "sward export meadow.sward -o meadow.glb")
    {
        app().add_option("FILE", file_, "Field file")->type_name("")->required();
        app()
            .add_option("-o,--output", output_,
                        "File to write; its extension chooses the format: .glb .ply .usda .csv; or "
                        "a folder, NAME/, for a page that shows the field in a browser")
            ->type_name("OUT")
            ->required();
        app().add_flag("--with-ground", settings_.withGround,
                       "Write the drawn ground too (.glb only)");
        app().add_flag("--for-engines", settings_.forEngines,
                       "Order the blades of each group by rank, so that any first part of them is "
                       "evenly spread, and add ranks, drawn colours and wind (.glb only)");
        app().add_flag("--compact", settings_.compact,
                       "Take few bytes for a blade, with small errors (.glb and .usda only)");
        app().add_flag("--with-ids", settings_.withIds, "With --compact, write ids of blades too");
        app()
            .add_option("--meshopt", meshopt_,
                        "Name of the compression in a compact .glb: EXT or KHR, the newer one")
            ->type_name("NAME")
            ->check(CLI::IsMember({"EXT", "KHR"}).description(""));
        app().add_flag("--tiles", tiles_,
                       "Write a folder OUT with 3D Tiles 1.1: tileset.json and compact .glb files");
        earth_.add(app());
        app()
            .add_option("--poster", poster_,
                        "Of a page: picture that it shows until the field is drawn, as "
                        "'sward-view render' writes one; becomes a JPEG of at most 150 kB")
            ->type_name("FILE");
        app().add_flag("--force", settings_.overwrite, "Overwrite an existing file");
        growth_.add(app(), "Of a field with seeds");
        log_.add(app());
        log_.addBar(app());
    }

    int run() const override
    {
        log_.apply();
        if (isPage(output_) && !tiles_)
            return exportPage();
        if (!poster_.empty())
            fail(ErrorKind::usage, "{}: --poster needs a page, an output NAME/", output_);
        // Check before any work.
        if (tiles_)
            return runTiles();
        if (earth_.isGiven())
            fail(ErrorKind::usage, "{}: --at, --crs and --geoid need --tiles", output_);
        const interchange::Format& format = interchange::formatOf(output_, settings_);
        if (!meshopt_.empty() && !(settings_.compact && format.hasGround))
            fail(ErrorKind::usage, "{}: --meshopt needs --compact and a .glb output", output_);
        checkOutput(output_, format.extension, {file_}, settings_.overwrite);

        writeField([&](const field::FieldView& view, const interchange::ExportSettings& settings,
                       Progress& progress, const field::Field*) {
            format.write(view, output_, settings, progress);
            return sizeText(std::filesystem::file_size(output_));
        });
        return 0;
    }

private:
    // Reads the field, or grows it, and calls write(view, settings, progress, grown field or null).
    // That returns what is said of the result.
    template <typename Write>
    void writeField(Write write) const
    {
        requireField(file_);
        // What is large stays on disk, unless seeds grow from it.
        const bool isFrugal = (tiles_ || settings_.compact) && !growth_.saysAnything();
        const field::MappedField field = field::readField(
            file_, {.withKeys = !isFrugal || settings_.withIds, .isFrugal = isFrugal});
        interchange::ExportSettings settings = settings_;
        if (isFrugal)
            settings.rest = [&field] { field.leaveOnDisk(); };
        settings.source = file_;
        if (!meshopt_.empty())
            settings.meshoptExtension = meshopt_ + "_meshopt_compression";
        settings.generator = versionText("sward");
        ProgressBar bar(log_.showBar());
        Progress progress(bar.callback());
        const CancelOnInterrupt cancel(progress);
        // A page sows the rest by itself.
        const bool sowsRest = isPage(output_) && !tiles_ && !growth_.saysAnything();
        const std::optional<field::Field> grown =
            sowsRest ? std::nullopt : growth_.grownOf(field.view(), 0, file_, "exported", progress);
        const field::FieldView view = grown ? field::viewOf(*grown) : field.view();
        const std::string said = write(view, settings, progress, grown ? &*grown : nullptr);
        bar.clear();
        writeResult(fmt::format("{}: {} blades, {}\n", output_, field::rootedBlades(view), said));
    }

    int runTiles() const
    {
        if (settings_.withGround || settings_.compact || settings_.forEngines)
            fail(ErrorKind::usage,
                 "{}: --tiles takes none of --compact, --for-engines and --with-ground", output_);
        NewOutputFolder::requirePlace(output_, tilesMark, settings_.overwrite);
        if (liesIn(file_, output_))
            fail(ErrorKind::usage, "{}: is read and lies in the folder {}", file_, output_);
        earth_.check(output_);
        writeField([&](const field::FieldView& view, interchange::ExportSettings settings,
                       Progress& progress, const field::Field*) {
            settings.map = earth_.map(view);
            if (!settings.map)
                settings.at = earth_.place();
            NewOutputFolder folder(output_, tilesMark, settings.overwrite);
            const interchange::TilesetSummary summary =
                interchange::writeTiles(view, folder.filling(), settings, progress);
            folder.put();
            return fmt::format("{} tiles, {}", summary.tiles, sizeText(summary.bytes));
        });
        return 0;
    }

    int exportPage() const
    {
        const std::filesystem::path folder(output_);
        if (settings_.withGround || settings_.compact || settings_.forEngines)
            fail(ErrorKind::usage,
                 "{}: a page takes none of --compact, --for-engines and --with-ground; they "
                 "need a .glb output",
                 output_);
        checkPage(folder, settings_.overwrite);
        const std::string poster = poster_.empty() ? std::string() : readPoster(poster_);
        writeField([&](const field::FieldView& view, const interchange::ExportSettings& settings,
                       Progress& progress, const field::Field* grown) {
            interchange::ExportSettings own = settings;
            own.poster = poster;
            std::uint64_t bytes = interchange::writePage(view, folder, own, progress);
            const std::filesystem::path copy = folder / "field.sward";
            bytes += grown != nullptr ? field::writeField(*grown, copy, settings.overwrite)
                                      : copyField(copy);
            return sizeText(bytes) + "; serve the folder, and open index.html";
        });
        return 0;
    }

    std::uint64_t copyField(const std::filesystem::path& copy) const
    {
        const MappedFile source(file_);
        AtomicFile target(copy, settings_.overwrite);
        target.write(source.bytes());
        target.commit();
        return source.bytes().size();
    }

    std::string file_;
    std::string output_;
    std::string meshopt_;
    std::string poster_;
    bool tiles_ = false;
    interchange::ExportSettings settings_;
    EarthOptions earth_;
    GrowthOptions growth_;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addExport(CLI::App& program)
{
    return std::make_unique<Export>(program);
}

} // namespace sward::apps
