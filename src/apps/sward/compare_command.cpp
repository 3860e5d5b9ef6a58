#include "apps/common/field_input.h"
#include "apps/common/output.h"
#include "apps/common/terminal/log_switches.h"
#include "apps/sward/files/transform_file.h"
#include "apps/sward/subcommand.h"
#include "core/error.h"
#include "field/inspect.h"
#include "field/read.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace sward::apps {
namespace {

bool hasIds(const field::FieldView& field)
{
    return field.keys.size() == field.blades.size();
}

// The comparison as a table, followed by the verdict.
std::string tableOf(const field::FieldView& first, const field::FieldView& second,
                    const field::Comparison& found, field::Match match)
{
    std::string text;
    const auto row = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<30}{}\n", name, value);
    };
    row("blades in A", fmt::format("{}", field::rootedBlades(first)));
    row("blades in B", fmt::format("{}", field::rootedBlades(second)));
    row(match == field::Match::id ? "matched by id" : "matched by order",
        fmt::format("{}", found.matched));
    row("only in A", fmt::format("{}", found.onlyFirst));
    row("only in B", fmt::format("{}", found.onlySecond));
    row("largest root distance", fmt::format("{:.6g} m", found.largestRootDistance));
    row("largest angle of up-vectors", fmt::format("{:.6g} rad", found.largestUpAngle));
    row("largest angle of facing", fmt::format("{:.6g} rad", found.largestFacingAngle));
    row("largest height difference",
        fmt::format("{:.4g} %", 100.0 * found.largestHeightDifference));
    row("largest width difference", fmt::format("{:.4g} %", 100.0 * found.largestWidthDifference));
    row("blades of different traits", fmt::format("{}", found.traitsDiffer));
    if (first.seeds == nullptr && second.seeds == nullptr)
        return text;
    if (!found.comparesSeeds) {
        row("seeds", "not compared: a transform moves them to other cells");
        return text;
    }
    row("cells of seeds in A", fmt::format("{}", found.seeds.first));
    row("cells of seeds in B", fmt::format("{}", found.seeds.second));
    row("cells only in A", fmt::format("{}", found.seeds.onlyFirst));
    row("cells only in B", fmt::format("{}", found.seeds.onlySecond));
    row("cells that differ", fmt::format("{}", found.seeds.differ));
    return text;
}

class Compare : public Subcommand {
public:
    explicit Compare(CLI::App& program)
        : Subcommand(
              program, "compare", "Compare two fields blade by blade; exit code 7 if they differ",
              "sward compare a.sward b.sward --transform turn.json --match id\n\n"
              "A transform is JSON: {\"matrix\": M} or M alone, where M is four rows of four\n"
              "numbers, three rows of three, or sixteen numbers column by column as in glTF; or\n"
              "{\"rotation\": [x, y, z, w], \"translation\": [x, y, z], \"scale\": s}.\n\n"
              "Seeds are compared number by number, but not under a transform.")
    {
        app().add_option("A", first_, "First field file")->type_name("")->required();
        app().add_option("B", second_, "Second field file")->type_name("")->required();
        app()
            .add_option("--transform", transform_,
                        "Rotation, uniform scale and translation that are applied to A")
            ->type_name("FILE.json");
        app()
            .add_option("--match", match_,
                        "Pair blades by their order in the files or by their ids")
            ->type_name("order|id")
            ->check(CLI::IsMember({"order", "id"}).description(""))
            ->default_str("id if both files have ids, else order");
        app()
            .add_option("--tolerance", tolerance_,
                        "Distance in metres that two paired roots may have, 0 or more")
            ->type_name("T")
            ->check(CLI::NonNegativeNumber.description(""))
            ->capture_default_str();
        log_.add(app());
    }

    int run() const override
    {
        log_.apply();
        const glm::dmat4 transform =
            transform_.empty() ? glm::dmat4(1.0) : readTransform(transform_);
        requireField(first_);
        requireField(second_);
        const field::MappedField first = field::readField(first_);
        const field::MappedField second = field::readField(second_);

        const bool byId =
            match_.empty() ? hasIds(first.view()) && hasIds(second.view()) : match_ == "id";
        const field::Match match = byId ? field::Match::id : field::Match::order;
        const field::Comparison found =
            field::compare(first.view(), second.view(), transform, match, tolerance_);

        std::string text = tableOf(first.view(), second.view(), found, match);
        for (const std::string& reason : found.reasons)
            text += "different: " + reason + "\n";
        const bool hasSeeds = first.view().seeds != nullptr || second.view().seeds != nullptr;
        if (found.reasons.empty())
            text +=
                hasSeeds && !found.comparesSeeds ? "the same but for the seeds\n" : "the same\n";
        writeResult(text);
        return found.reasons.empty() ? 0 : static_cast<int>(ErrorKind::difference);
    }

private:
    std::string first_;
    std::string second_;
    std::string transform_;
    std::string match_;
    double tolerance_ = 1e-3;
    LogSwitches log_;
};

} // namespace

std::unique_ptr<Subcommand> addCompare(CLI::App& program)
{
    return std::make_unique<Compare>(program);
}

} // namespace sward::apps
