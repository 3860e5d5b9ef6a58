#include "apps/common/output.h"
#include "apps/sward/bake_summary.h"
#include "apps/sward/subcommand.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "field/read.h"
#include "interchange/csv.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>

namespace sward::apps {
namespace {

using Writer = void (*)(const field::FieldView&, const std::filesystem::path&, bool overwrite);

// Each format by its extension.
struct Format {
    const char* extension;
    Writer write;
};
constexpr Format formats[] = {{".csv", interchange::writeCsv}};

const Format& formatOf(const std::filesystem::path& path)
{
    std::string known;
    for (const Format& format : formats) {
        if (path.extension() == format.extension)
            return format;
        known += std::string(known.empty() ? "" : ", ") + format.extension;
    }
    fail(ErrorKind::unsupported, "{}: cannot export to '{}'; known are {}", path.string(),
         path.extension().string(), known);
}

class Export : public Subcommand {
public:
    explicit Export(CLI::App& program)
        : Subcommand(program, "export", "Write a field for other programs",
                     "sward export meadow.sward -o meadow.csv")
    {
        app().add_option("FILE", file_, "Field file")->type_name("")->required();
        app()
            .add_option("-o,--output", output_, "File to write; its extension says how: .csv")
            ->type_name("OUT")
            ->required();
        app().add_flag("--force", overwrite_, "Overwrite an existing file");
    }

    int run() const override
    {
        // Refuse before any work.
        const Format& format = formatOf(output_);
        refuseOverwrite(output_, overwrite_);
        const field::MappedField field = field::readField(file_);
        format.write(field.view(), output_, overwrite_);
        writeResult(fmt::format("{}: {} blades, {}\n", output_, field.view().blades.size(),
                                sizeText(std::filesystem::file_size(output_))));
        return 0;
    }

private:
    std::string file_;
    std::string output_;
    bool overwrite_ = false;
};

} // namespace

std::unique_ptr<Subcommand> addExport(CLI::App& program)
{
    return std::make_unique<Export>(program);
}

} // namespace sward::apps
