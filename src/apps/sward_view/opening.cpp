#include "apps/sward_view/opening.h"

#include "apps/sward_view/interface/units.h"
#include "core/error.h"
#include "core/log.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>
#include <vector>

namespace sward::view {
namespace {

// The errors that `sward` itself knows keep their exit code.
ErrorKind kindOf(const Baking& baking)
{
    if (baking.isCancelled())
        return ErrorKind::interrupted;
    constexpr std::array known{ErrorKind::usage, ErrorKind::io, ErrorKind::input,
                               ErrorKind::unsupported, ErrorKind::interrupted};
    const auto* const found = std::find_if(known.begin(), known.end(), [&](ErrorKind kind) {
        return static_cast<int>(kind) == baking.exitCode();
    });
    return found == known.end() ? ErrorKind::runtime : *found;
}

} // namespace

void Opening::open(const std::string& input, MeadowWishes wishes)
{
    loader_.reset();
    baking_.reset();
    input_ = input;
    report_.clear();
    if (!wantsBaking(input)) {
        startToRead();
        return;
    }
    log::info("{}: is not a field; growing grass on it first", input);
    wishes.ground = input;
    baking_ = std::make_unique<Baking>(bakeArguments(wishes));
}

void Opening::startToRead()
{
    loader_ = std::make_unique<FieldLoader>(input_, baking_ ? baking_->field()
                                                            : std::filesystem::path(input_));
}

void Opening::cancel()
{
    if (baking_)
        baking_->cancel();
}

std::optional<Opening::Opened> Opening::poll()
{
    if (baking_ && !loader_ && baking_->poll()) {
        if (!baking_->succeeded()) {
            const std::unique_ptr<Baking> ended = std::move(baking_);
            fail(kindOf(*ended), "{}: no grass has grown on it: {}", input_, ended->complaint());
        }
        report_ = reportText(baking_->report());
        startToRead();
    }
    if (!loader_ || !loader_->isDone())
        return std::nullopt;
    // The mapping outlives the file's name.
    const std::unique_ptr<FieldLoader> done = std::move(loader_);
    const std::unique_ptr<Baking> baked = std::move(baking_);
    return Opened{done->take(), std::move(report_)};
}

std::string reportText(const std::filesystem::path& report)
{
    std::ifstream in(report);
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (json.is_discarded() || !json.contains("roots"))
        return {};
    const auto& roots = json["roots"];
    std::string text = fmt::format("{} of {} roots kept", countText(roots.value("kept", 0ull)),
                                   countText(roots.value("proposed", 0ull)));
    std::vector<std::pair<std::uint64_t, std::string>> reasons;
    if (roots.contains("rejected") && roots["rejected"].is_object())
        for (const auto& [reason, count] : roots["rejected"].items())
            if (count.is_number_unsigned() && count.get<std::uint64_t>() > 0)
                reasons.emplace_back(count.get<std::uint64_t>(), reason);
    std::sort(reasons.rbegin(), reasons.rend());
    for (const auto& [count, reason] : reasons)
        text += fmt::format("\n{} left out: {}", countText(count), reason);
    if (json.contains("warnings") && json["warnings"].is_array())
        for (const auto& warning : json["warnings"])
            text += "\n" + (warning.is_string() ? warning.get<std::string>() : warning.dump());
    return text;
}

} // namespace sward::view
